#pragma once

#include "core/mesh/ElementTree.h"

#include <string>

/// \file Refinement.h
/// When two elements are too coarse for one interaction (Hanrahan, Salzman, Aupperle 1991).

namespace vantage
{

enum class RefinementOracle
{
  F, ///< form factor alone: the interactions depend on geometry only
  BF ///< form factor weighted by the power that is going to be carried (RadiancePrediction.h)
};

/// All tolerances are relative, so that a scene in millimetres and one in kilometres refine alike.
struct RefinementSettings
{
  RefinementOracle oracle = RefinementOracle::BF;
  /// F: largest classical form factor from the smaller to the larger end that an interaction may
  /// have without being refined, (0, 1]. The error of a constant kernel falls with it.
  double formFactorTolerance = 0.1;
  /// BF: largest part of the power of the strongest emitter that may be at stake in an interaction,
  /// >= 0. At stake is what the interaction is going to carry times the variation of the kernel
  /// over its ends (their sizes over their distance); all it carries where it is partly visible.
  double powerTolerance = 3e-4;
  /// BF: the same for direct light that is partly visible: at shadow boundaries, >= 0.
  double shadowTolerance = 1e-4;
  /// Elements are not split below this edge length, relative to the square root of the mean facet
  /// area, > 0.
  double minimumElementSize = 0.05;
  int maximumLevel = 10; ///< splits below a patch, 0 .. 20; 0: one element a patch

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// "F", "BF".
std::string NameOf(RefinementOracle oracle);
/// \throw UnknownNameError
RefinementOracle RefinementOracleFromName(const std::string& name);

/// What the oracle is told of a pair that could become an interaction.
struct RefinementQuery
{
  NodeId first;
  NodeId second;
  double throughput;    ///< m^2 sr, visibility included
  double visibility;    ///< (0, 1]
  double relativePower; ///< the larger one of what both ends shoot / power of the strongest emitter
  bool isDirect;        ///< an end emits
};

/// Which ends of a pair to split.
struct SplitChoice
{
  bool first = false;
  bool second = false;

  bool Any() const { return this->first || this->second; }
};

/// Decides whether an interaction is refined, and which end is split for it.
class Refiner
{
public:
  /// `meanFacetArea` is what RefinementSettings::minimumElementSize refers to.
  Refiner(const RefinementSettings& settings, double meanFacetArea);

  /// Neither end when the interaction is fine enough or none may be split any more; else the
  /// larger one that may be. Ends of the same size are split both, or the choice would depend on
  /// their numbering.
  SplitChoice Choose(const ElementTree& tree, const RefinementQuery& query) const;

private:
  bool IsTooCoarse(const ElementTree& tree, const RefinementQuery& query) const;
  bool MaySplit(const Node& node) const;

  RefinementSettings Settings;
  double MinimumLength;
};

} // namespace vantage
