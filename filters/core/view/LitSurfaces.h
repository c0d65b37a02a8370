#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/view/BrightSpots.h"
#include "core/view/LightTexels.h"
#include "core/view/NamedLamps.h"
#include "core/visibility/OccluderScene.h"

#include <glm/mat3x3.hpp>

#include <cstdint>
#include <vector>

/// \file LitSurfaces.h
/// What a surface that a ray has met sends back.

namespace vantage
{

/// Radiance of a surface that it reflects, W m^-2 sr^-1.
struct LitRadiance
{
  Color direct{ 0.0 };                     ///< of light straight from named lamps
  Color indirect{ 0.0 };                   ///< of all other light
  RadianceSolution::NodeIndex leaf = None; ///< the element; None on an inactive side
  std::uint32_t texel = None;              ///< as LightTexels::Place
  Vec2 within{ 0.0 };                      ///< the same
};

/// What tells of the light of lamps.
enum class LitBy
{
  Texels, ///< where there are any
  ShadowRays
};

/// Radiance of surfaces without their own emission, at points that rays find. Light of the named
/// lamps, of which each is one however it was cut (NamedLamps.h), is estimated at the point: closed
/// form, times one shadow ray to each; from more than
/// `MostLamps` so many are drawn, the more often the more they are likely to give. Where many rays
/// come, that is done for a sample of them, of which texels keep the means. The rest, what reached
/// the surface by reflections, is taken from the element. So elements need not be fine enough for
/// the shadows and spots that lamps make.
///
/// Refers to occluders and solution, which must outlive it. O(lamps) to make.
class LitSurfaces
{
public:
  static constexpr std::uint32_t MostLamps = 8;

  LitSurfaces(const OccluderScene& occluders, const RadianceSolution& solution);

  /// An estimate: by shadow rays, all of a lamp or nothing, as a point of it is seen that is drawn
  /// by what it gives. So there is no noise where a lamp is hidden, or seen, as a whole. Black on
  /// an inactive side. `index` and `seed` name the sample; those of one seed are spread well. Adds
  /// to `shadowRays` what it traces. Pure.
  LitRadiance Radiance(const Hit& hit, LitBy by, std::uint32_t index, std::uint64_t seed,
    std::uint64_t& shadowRays) const;

  /// Makes texels, for rays that are distributed as the sample is, on active sides. Estimates are
  /// those of Radiance() with the places in the sample as indices. Returns the shadow rays that it
  /// took. Parallel over the sample, the same for any number of threads.
  /// \param origins of the rays that met the sample; to find bright spots by
  std::uint64_t LightSample(
    const std::vector<Hit>& sample, const RayOrigins& origins, std::uint64_t seed);

  /// RadianceSolution::Element::indirect of a leaf, or what it was replaced by.
  const Color& Indirect(RadianceSolution::NodeIndex leaf) const { return this->OfElements[leaf]; }
  void SetIndirect(RadianceSolution::NodeIndex leaf, const Color& radiance)
  {
    this->OfElements[leaf] = radiance;
  }

  /// Among the texels; none before LightSample().
  const BrightSpots& Spots() const { return this->Bright; }

private:
  struct Face
  {
    Polygon shape;
    Vec3 centre;
    Vec3 normal;
    double radius; ///< around the centre
    double area;
    std::uint32_t facet;

    Face(const Polygon& outline, std::uint32_t itsFacet);
  };
  /// One face, or some of a convex surface.
  struct Lamp
  {
    std::vector<Face> faces;
    std::vector<double> areasTo; ///< of the faces, up to and with each
    Vec3 centre{ 0.0 };
    double radius = 0.0; ///< around the centre
    double area = 0.0;
    Vec3 areaNormal{ 0.0 };       ///< sum over the faces
    glm::dmat3 areaTensor{ 0.0 }; ///< of area times normal times normal
    Color emission;

    explicit Lamp(const NamedLamp& named);
    /// Area that is seen from a direction, times the cosine: exact of one face, within a sixth of
    /// many.
    double AreaTowards(const Vec3& direction) const;
  };

  /// A point that lamps may shine on.
  struct LitPoint
  {
    SurfacePoint place;
    Vec3 normal;
  };

  Color Irradiance(const Hit& hit, RadianceSolution::NodeIndex leaf, std::uint32_t index,
    std::uint64_t seed, std::uint64_t& shadowRays) const;
  double Likely(std::uint32_t lamp, const LitPoint& point) const;
  double Factor(std::uint32_t lamp, const LitPoint& point, std::uint32_t index, std::uint64_t seed,
    std::uint64_t& shadowRays) const;
  double Unhidden(std::uint32_t lamp, const LitPoint& point) const;
  static bool IsAboveHorizon(const Polygon& shape, const LitPoint& point);
  static double GivenByArea(const Face& face, const LitPoint& point);
  static const Face& FaceTowards(
    const Lamp& lamp, const LitPoint& point, std::uint32_t index, std::uint64_t seed);
  static const Face& FaceOfAll(const Lamp& lamp, const LitPoint& point, double u);
  static Vec3 TargetByDirection(
    const Face& face, const LitPoint& point, std::uint32_t index, std::uint64_t seed);
  static Vec3 TargetByArea(
    const Face& face, const LitPoint& point, std::uint32_t index, std::uint64_t seed);
  Color FromSome(const LitPoint& point, const NamedLamps::List& lamps, std::uint32_t index,
    std::uint64_t seed, std::uint64_t& shadowRays) const;

  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
  LightTexels Texels;
  BrightSpots Bright;
  std::vector<Color> OfElements; ///< indirect radiance of each
  NamedLamps Named;
  std::vector<Lamp> Lamps; ///< of each of these
};

} // namespace vantage
