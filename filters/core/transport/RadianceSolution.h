#pragma once

#include "core/mesh/ElementTree.h"
#include "core/transport/PatchOptics.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file RadianceSolution.h
/// What a solver knows about the light on every surface, for those who look at it.

namespace vantage
{

/// Where a point lies on a patch: (s, t) of the bilinear map on a quadrilateral, the barycentric
/// coordinates of corners 1 and 2 on a triangle. Halving them goes down the element tree.
class PatchCoordinates
{
public:
  PatchCoordinates() = default;
  /// \pre a convex polygon of three or four corners
  explicit PatchCoordinates(const Polygon& shape);

  bool IsTriangle() const { return this->Corners == 3; }
  Vec2 Of(const Vec3& point) const
  {
    const Vec3 x = point - this->Origin;
    const Vec2 affine(glm::dot(x, this->DualU), glm::dot(x, this->DualV));
    return this->IsAffine ? affine : this->Bilinear(affine);
  }

private:
  Vec2 Bilinear(const Vec2& affine) const;

  Vec3 Origin{ 0.0 };
  Vec3 DualU{ 0.0 }, DualV{ 0.0 }; ///< of the edges from corner 0 to corner 1, and to the last one
  Vec2 Twist{ 0.0 };               ///< corner 0 - corner 1 + corner 2 - corner 3 in that basis
  std::uint8_t Corners = 0;
  bool IsAffine = true; ///< a triangle or a parallelogram
};

/// Moves coordinates within an element on to those within the quarter of it that holds the place,
/// and returns which child that is (ElementTree::Split). A place outside goes to one near by.
std::uint32_t ToQuarter(bool isTriangle, Vec2& place);

/// The light on all surfaces at one moment. It is plain data that refers to nothing else, so it
/// stays valid whatever becomes of the solver that made it. Patches are numbered as in the
/// ElementTree of the same facets.
///
/// Light that comes straight from a lamp is known twice. It is part of `reflected`, as coarse as
/// the elements are; and each element names the lamps it comes from, so that who wants it exactly
/// can compute it at a point and add it to `indirect`, what is left of `reflected` without it.
struct RadianceSolution
{
  using NodeIndex = std::uint32_t;

  /// An element (or a patch, or a cluster of patches that nobody looked into).
  struct Element
  {
    Color reflected{ 0.0 }; ///< radiance without own emission, mean over it, W m^-2 sr^-1
    /// The part of it that does not come straight from named lamps. Of leaves only.
    Color indirect{ 0.0 };
    /// Irradiance from lamps that are too far or too faint to be named, W m^-2. Of leaves only.
    Color unnamedDirect{ 0.0 };
    double area = 0.0; ///< m^2
    NodeIndex firstChild = None;
    NodeId node = None; ///< its id in the element tree of the solver
    /// Named lamps: lamps[firstLamp .. lastLamp), ascending. Of leaves (childCount = 0) only.
    std::uint32_t firstLamp = 0;
    std::uint32_t lastLamp = 0;
    std::uint8_t childCount = 0; ///< 0 or 4: as ElementTree::Split makes them

    NodeIndex EndOfChildren() const { return this->firstChild + this->childCount; }
  };

  std::vector<Element> elements;
  std::vector<NodeIndex> elementOfPatch;     ///< where a patch starts; None for an inactive side
  std::vector<PatchCoordinates> coordinates; ///< of the patches that were split; see StartAt()
  std::vector<std::uint32_t> coordinatesOfPatch; ///< index, or None
  std::vector<PatchId> lamps;  ///< emitting patches, in ranges that elements refer to
  std::vector<Color> emission; ///< of each patch, W m^-2 sr^-1
  std::vector<Color> albedo;   ///< of each patch

  /// Emission and albedo of the patches; none has elements yet.
  void SetPatches(const std::vector<PatchOptics>& optics);
  /// Where a patch of that shape starts. \pre the element is complete
  void StartAt(PatchId patch, const Polygon& shape, NodeIndex element);

  bool IsActive(PatchId patch) const { return this->elementOfPatch[patch] != None; }

  /// The leaf element of a patch that holds a point of it; a point outside goes to one near the
  /// border. \pre the patch is active. A few nanoseconds a level.
  NodeIndex LeafAt(PatchId patch, const Vec3& point) const;

  std::size_t Bytes() const;
};

} // namespace vantage
