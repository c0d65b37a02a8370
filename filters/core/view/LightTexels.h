#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/visibility/OccluderScene.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file LightTexels.h
/// The light of lamps on surfaces that many rays will meet, found once for all of them.

namespace vantage
{

/// Irradiance from the named lamps at a sample of what rays will meet. Patches are quartered as
/// their elements are, and further while a quarter has more than a few of the sample: these are the
/// texels, and each has the mean of its hits. So they are small where rays are dense; and they are
/// right in the mean over the rays, if those that come are distributed as the sample is: where half
/// of a texel is hidden from them, that half does not count. What the light varies within texels
/// adds to the noise of the rays. An element that the sample has missed is one texel of which
/// nothing is known, and so are those of a patch with a few hits only. Other patches have none.
class LightTexels
{
public:
  /// None.
  LightTexels() = default;
  /// \param sample of what rays will meet, on active sides
  /// \param irradiance of each of them, W m^-2; its noise may be large, as texels are means
  /// Parallel over patches, the same for any number of threads. O(patches + n log n) for n hits.
  LightTexels(const OccluderScene& occluders, const RadianceSolution& solution,
    const std::vector<Hit>& sample, const std::vector<Color>& irradiance);

  /// What is known at a point of an active patch.
  struct Place
  {
    RadianceSolution::NodeIndex leaf; ///< its element
    const Color* irradiance;          ///< W m^-2; null where nothing is known
    std::uint32_t texel;              ///< its number, or None
    Vec2 within; ///< coordinates in the texel; of a quadrilateral those of PointAt()
  };
  /// As fast as RadianceSolution::LeafAt. \param solution the same one
  Place At(const RadianceSolution& solution, PatchId patch, const Vec3& point) const;

  /// A texel and what is known of it.
  struct Texel
  {
    PatchId patch;
    Polygon shape; ///< counter-clockwise from the patch's side
    RadianceSolution::NodeIndex leaf;
    const Color* irradiance; ///< as above
    std::uint32_t hits;
  };
  /// All there are, by their numbers. What they refer to lives as long as this does.
  std::vector<Texel> All(const OccluderScene& occluders) const;

private:
  /// A quadtree over a patch, whose leaves are texels. A node has the mean of its hits, or, without
  /// any, that of its parent if both lie in one element.
  class Tree
  {
  public:
    explicit Tree(const PatchCoordinates& map)
      : Map(map)
    {
    }
    void Add(const Vec3& point, const Color& irradiance);
    /// Of all that was added. \param root the element of the patch
    void Build(const RadianceSolution& solution, RadianceSolution::NodeIndex root);
    /// From `first` on. Returns the number after the last.
    std::uint32_t NumberTexels(std::uint32_t first);
    Place At(const Vec3& point) const;
    /// Appends the texels, by their numbers.
    void List(PatchId patch, const Polygon& shape, std::vector<Texel>& texels) const;

  private:
    struct Node
    {
      Color irradiance{ 0.0 };
      RadianceSolution::NodeIndex leaf = None; ///< the element it lies in, if that is not split
      std::uint32_t firstChild = None;         ///< of four
      std::uint32_t hits = 0;
      std::uint32_t texel = None; ///< its number, without children
      bool isLit = false;         ///< there is an irradiance
    };
    /// A hit.
    struct Sample
    {
      Vec2 place; ///< coordinates within the node it has come to
      Color irradiance;
      std::uint32_t quarter = 0; ///< of that node
    };

    void Build(std::uint32_t node, const RadianceSolution& solution,
      RadianceSolution::NodeIndex element, Sample* first, Sample* last, int level);
    void Light(std::uint32_t node, const Sample* first, const Sample* last);
    std::uint32_t Split(std::uint32_t node);
    std::array<Sample*, 5> Sort(Sample* first, Sample* last) const;
    static const Color* IrradianceOf(const Node& node)
    {
      return node.isLit ? &node.irradiance : nullptr;
    }

    PatchCoordinates Map;
    std::vector<Sample> Samples; ///< until it is built
    std::vector<Node> Nodes;
    bool IsKnown = false; ///< by more than a few hits
  };

  std::vector<std::uint32_t> TreeOfPatch; ///< index, or None
  std::vector<Tree> Trees;
};

} // namespace vantage
