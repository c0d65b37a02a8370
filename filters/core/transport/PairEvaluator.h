#pragma once

#include "core/formfactor/FormFactor.h"
#include "core/mesh/ElementTree.h"
#include "core/visibility/OccluderScene.h"
#include "core/visibility/PairVisibility.h"

#include <cstdint>

/// \file PairEvaluator.h
/// Throughput and visibility of pairs of elements: the expensive part, pure and parallel.

namespace vantage
{

/// A pair to evaluate, and what is known from the coarser pair it refines.
struct ElementPair
{
  NodeId first;
  NodeId second;
  double parentVisibility = 0.5;        ///< of the pair that is refined
  std::uint32_t parentAgreeingRays = 0; ///< PairValue::agreeingRays of that pair
  bool isRoot = false;                  ///< two whole patches: nothing is known of them
};

struct PairValue
{
  double throughput = 0.0; ///< m^2 sr, visibility included
  double visibility = 0.0;
  /// Rays that found the same, all free or all hidden, down the chain of ancestors to here; 0
  /// where they disagreed.
  std::uint32_t agreeingRays = 0;
  std::uint32_t rays = 0; ///< traced for this pair
};

/// Stands for "proved": more agreeing rays than any certificate asks for.
inline constexpr std::uint32_t Certain = 1u << 20;

/// Agreeing rays after which the visibility of a pair is taken for granted in its refinements.
inline constexpr std::uint32_t CertifyingRays = 24;

class PairEvaluator
{
public:
  /// `visibilityRays` for a pair that is partly visible; four times as many for a pair of whole
  /// patches, whose children inherit the verdict.
  PairEvaluator(const OccluderScene& occluders, Accuracy accuracy, std::uint32_t visibilityRays);

  /// Pure; the same for either order of the ends.
  PairValue Evaluate(const ElementTree& tree, const ElementPair& pair) const;

private:
  const OccluderScene* Occluders;
  Accuracy TheAccuracy;
  std::uint32_t VisibilityRays;
};

/// Rays that found the same of a pair and of the ancestors that found the same too, as
/// PairValue::agreeingRays has them.
/// \param parentVisibility and `parentAgreeingRays` of the pair that is refined
std::uint32_t AgreeingRays(
  const PairVisibility& seen, double parentVisibility, std::uint32_t parentAgreeingRays);

/// Whether some of each shape lies in front of the other one.
bool FaceEachOther(const Polygon& a, const Polygon& b);

} // namespace vantage
