#pragma once

#include "core/formfactor/FormFactor.h"
#include "core/goal/Link.h"

#include <cstdint>

/// \file LinkEvaluator.h
/// Throughput of hierarchical interactions, and how well it is known: pure and parallel.

namespace vantage
{

/// A link that is to be made, and the one it refines.
struct LinkRequest
{
  std::array<OpenId, 2> ends;
  double parentVisibility = 0.5;
  std::uint32_t parentAgreeingRays = 0;
};

/// A link, and what it cost.
struct EvaluatedLink
{
  Link link;
  bool isKnownHidden = false; ///< proved: nothing passes, ever
  std::uint32_t rays = 0;
};

class LinkEvaluator
{
public:
  /// `rays` for a pair that is partly visible; `seed` of all that is random.
  LinkEvaluator(const OpenTree& tree, const OccluderScene& occluders, std::uint32_t rays,
    std::uint64_t seed = 1);

  /// Pure; the same for either order of the ends.
  ///
  /// Two patches or elements: closed form (FormFactor.h) times the visible fraction
  /// (PairVisibility.h), which is taken over from the parent after enough agreeing rays.
  /// Where a cluster takes part: the mean over pairs of points of both ends, drawn half by area and
  /// half by emitted power so that a small lamp is met, with a ray each where they face each other.
  /// Link::variation is known where all clusters are parts of curved surfaces.
  EvaluatedLink Evaluate(const LinkRequest& request) const;

private:
  EvaluatedLink EvaluateSurfaces(const LinkRequest& request) const;
  EvaluatedLink EvaluateClusters(const LinkRequest& request) const;

  const OpenTree* Tree;
  const OccluderScene* Occluders;
  std::uint32_t Rays;
  std::uint64_t Seed;
};

} // namespace vantage
