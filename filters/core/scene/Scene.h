#pragma once

#include "core/math/Types.h"
#include "core/scene/Camera.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// \file Scene.h
/// What is to be lit: polygons, materials, cameras. Plain data, checked by Validate().

namespace vantage
{

/// Whether an emission is none, or one whose square neither vanishes nor overflows when it is
/// multiplied with albedos and areas.
inline bool IsComputable(double emission)
{
  return emission == 0.0 || (emission >= 1e-100 && emission <= 1e100);
}

/// How a polygon reflects and emits. Diffuse BRDF = albedo / pi.
struct Material
{
  std::string name;
  Color albedo{ 0.5 };   ///< reflected / incident flux, each channel in [0, 1]
  Color emission{ 0.0 }; ///< emitted radiance of the front side, W m^-2 sr^-1, 0 or 1e-100 .. 1e100
  Color specular{ 0.0 }; ///< reflectance of the normalised Phong lobe; albedo + specular <= 1
  double shininess = 0.0; ///< exponent of that lobe, >= 0
  bool twoSided = true;   ///< false: the back side neither reflects nor emits (it still occludes)
};

/// What materials have that no method computes, one line each: specular parts.
std::vector<std::string> WarningsOf(const std::vector<Material>& materials);

/// Polygons over shared vertices. Polygon p has the vertices indices[offsets[p]] ..
/// indices[offsets[p + 1] - 1], counter-clockwise seen from its front (right-hand rule).
struct Scene
{
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> offsets{ 0 };
  std::vector<std::uint32_t> materialOfPolygon;
  std::vector<Material> materials;
  std::vector<Camera> cameras;

  std::size_t PolygonCount() const { return this->offsets.size() - 1; }

  /// Appends a polygon over new vertices, front side by the right-hand rule.
  void AddPolygon(const std::vector<Vec3>& points, std::uint32_t material);

  /// \throw InputError naming the first polygon, vertex, material or camera that is wrong: no
  /// polygons, index out of range, NaN or infinite numbers, albedo outside [0, 1], emission
  /// out of range, albedo + specular above 1.
  void Validate() const;

  /// \throw UnknownNameError when there is no camera of that name.
  const Camera& FindCamera(const std::string& name) const;
};

} // namespace vantage
