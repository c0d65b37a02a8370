#include "SceneSummary.h"

#include "core/mesh/DarkSides.h"
#include "io/TextLines.h"

#include <algorithm>

#include <map>
#include <sstream>

namespace vantage
{

namespace
{

struct Emitter
{
  std::size_t polygons = 0;
  double area = 0.0;
  Color power{ 0.0 }; ///< W
};

/// Emitting materials in use; a diffuse emitter of radiance L and area A emits pi L A.
std::map<std::uint32_t, Emitter> EmittersOf(const Scene& scene, const FacetSet& facets)
{
  std::map<std::uint32_t, Emitter> emitters;
  for (const Facet& facet : facets.facets)
  {
    for (const Side side : { Side::Front, Side::Back })
    {
      const std::uint32_t id = facet.MaterialOf(side);
      const Color& emission = scene.materials[id].emission;
      if (facet.IsPolygonFront(side) && MaxChannel(emission) > 0.0)
      {
        Emitter& emitter = emitters[id];
        const double area = Area(facet.shape);
        ++emitter.polygons;
        emitter.area += area;
        emitter.power += Pi * area * emission;
      }
    }
  }
  return emitters;
}

/// "3 polygons were not flat: triangulated", or nothing for a count of zero.
void Count(std::size_t count, const std::string& what, std::vector<std::string>& lines)
{
  if (count > 0)
  {
    lines.push_back(std::to_string(count) + " " + what);
  }
}

std::string Print(const Vec3& v)
{
  std::ostringstream text;
  text << v.x << ' ' << v.y << ' ' << v.z;
  return text.str();
}

} // namespace

std::vector<std::string> SceneWarnings(const Scene& scene, const FacetSet& facets)
{
  std::vector<std::string> lines;
  const FacetReport& report = facets.report;
  Count(report.weldedVertices, "vertices were moved onto a close neighbour", lines);
  Count(report.degeneratePolygons, "polygons have no area and were dropped", lines);
  Count(report.nonPlanarPolygons, "polygons are not flat and were triangulated", lines);
  Count(report.duplicateFacets, "faces lie on an equal one and were dropped", lines);
  for (const std::string& line : WarningsOf(scene.materials))
  {
    lines.push_back(line);
  }
  if (EmittersOf(scene, facets).empty())
  {
    lines.push_back("nothing emits light, all will be black; give a material an emission (Ke)");
  }
  return lines;
}

std::string DescribeScene(const Scene& scene, const FacetSet& facets)
{
  const std::vector<std::uint32_t> bodyOf = FindDarkSides(facets, scene.materials).bodyOf;
  const auto darkSides =
    static_cast<std::ptrdiff_t>(bodyOf.size()) - std::count(bodyOf.begin(), bodyOf.end(), None);
  std::ostringstream text;
  text << "vertices     " << scene.vertices.size() << "\npolygons     " << scene.PolygonCount()
       << "\nfacets       " << facets.facets.size() << " after cleaning ("
       << facets.report.concavePolygons << " concave and " << facets.report.largePolygons
       << " large polygons triangulated, " << facets.report.mergedFacets
       << " merged back to back)\ndark sides   " << darkSides
       << " inside closed bodies without a lamp: they take no part\nmaterials    "
       << scene.materials.size() << "\nbounding box " << Print(facets.low) << " to "
       << Print(facets.high) << '\n';
  for (const auto& [id, emitter] : EmittersOf(scene, facets))
  {
    text << "emitter      " << scene.materials[id].name << ": " << emitter.polygons << " facets, "
         << emitter.area << " square units, " << Print(emitter.power) << " W\n";
  }
  for (const Camera& camera : scene.cameras)
  {
    text << "camera       " << camera.name << ": eye " << Print(camera.eye) << ", look-at "
         << Print(camera.lookAt) << ", " << camera.fieldOfView << " degrees, aspect "
         << camera.aspect << '\n';
  }
  return text.str();
}

} // namespace vantage
