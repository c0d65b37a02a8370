#pragma once

#include "core/view/LightTexels.h"

#include <cstdint>
#include <vector>

/// \file BrightSpots.h
/// Directions to where much light comes from: few rays would find it by chance.

namespace vantage
{

/// Where rays start that are distributed by the cosine.
struct RayOrigins
{
  struct Place
  {
    Vec3 point;
    Vec3 normal; ///< unit
  };
  std::vector<Place> places; ///< a sample
  double rays = 0.0;         ///< from there, in all
};

/// The texels (LightTexels.h) that are much brighter than what rays usually meet, those that bring
/// most noise if there are many. How bright a texel is of which nothing is known, the solution
/// says.
class BrightSpots
{
public:
  struct Spot
  {
    Vec3 centre;
    Vec3 normal;
    double radius; ///< around the centre
    double area;
    double radiance;      ///< mean of channels, about, W m^-2 sr^-1
    double visible = 1.0; ///< part of it that rays see, about, in the mean over them
  };

  /// None.
  BrightSpots() = default;
  /// \param indirect radiance of each element of the solution, W m^-2 sr^-1
  /// \param origins of the rays of whose hits the texels were made; without any, all is visible
  /// \param usual mean radiance of what these met, mean of channels
  /// O(texels + origins).
  BrightSpots(const OccluderScene& occluders, const RadianceSolution& solution,
    const LightTexels& texels, const std::vector<Color>& indirect, const RayOrigins& origins,
    double usual);

  const std::vector<Spot>& All() const { return this->Spots; }
  std::uint32_t TexelOf(std::size_t spot) const { return this->TexelOfSpot[spot]; }
  /// Counter-clockwise from its front.
  const Polygon& ShapeOf(std::size_t spot) const { return this->Shapes[spot]; }
  /// The spot that a texel is, or None. \param texel a number, or None
  std::uint32_t OfTexel(std::uint32_t texel) const
  {
    return texel < this->SpotOfTexel.size() ? this->SpotOfTexel[texel] : None;
  }
  double UsualRadiance() const { return this->Usual; }

private:
  void Add(std::uint32_t texel, const Polygon& shape, double radiance);

  std::vector<Spot> Spots;
  std::vector<std::uint32_t> TexelOfSpot;
  std::vector<Polygon> Shapes;
  std::vector<std::uint32_t> SpotOfTexel;
  double Usual = 0.0;
};

/// Draws places on bright spots about as they light a point. Refers to the spots. O(spots) to make.
class SpotDirections
{
public:
  /// \param normal of the surface at the point, unit
  SpotDirections(const BrightSpots& spots, const Vec3& point, const Vec3& normal);

  /// How many of so many rays are better drawn here than by the cosine: one of eight, or none where
  /// that would take little from their noise.
  std::uint32_t PartOf(std::uint32_t rays) const;

  struct Target
  {
    std::uint32_t texel;
    Vec3 place;
  };
  /// \param u uniform in [0, 1)^2 \pre PartOf() gives some
  Target Draw(const Vec2& u) const;

  /// Of the direction to a place on a texel, sr^-1; 0 for one that is never drawn.
  /// \param within coordinates of the place in the texel (LightTexels::Place)
  /// \pre PartOf() gives some
  double Density(std::uint32_t texel, const Vec2& within, const Vec3& place) const;

private:
  double SumBefore(std::size_t spot) const { return spot > 0 ? this->Sums[spot - 1] : 0.0; }

  const BrightSpots* Spots;
  Vec3 Point;
  std::vector<double> Sums; ///< of the irradiance from the spots up to and with each, W m^-2
  double Gain = 0.0;        ///< what is taken from the variance of a ray, W^2 m^-4
};

} // namespace vantage
