#include "core/view/MeshGather.h"

#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/view/ElementImage.h"
#include "core/view/MeshRefinement.h"

#include <algorithm>
#include <string>
#include <utility>

namespace vantage
{

namespace
{

/// Points of the image that measure what interpolation adds.
constexpr std::size_t Judges = 4096;

/// Points of a surface whose light is to be gathered.
struct PointsInView
{
  std::vector<GatherPoint> points;
  std::vector<std::uint32_t> ids; ///< of the points in the surface
};

/// The points of all patches that the view sees, each with the part of the view around it.
PointsInView FindPoints(const GatheredMesh& mesh, const std::vector<ViewSample>& view)
{
  std::vector<char> isSeen(mesh.tree.Patches().size(), 0);
  for (const ViewSample& sample : view)
  {
    isSeen[sample.patch] = 1;
  }
  ViewWeights weights;
  weights.Set(mesh.tree, view);
  const ElementSurface& surface = mesh.surface;
  std::vector<GatherPoint> points(surface.points.size(), { None, Vec3(0.0), 0.0 });
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    const Node& node = mesh.tree[surface.elements[p]];
    const double weight = weights.Value(mesh.tree, surface.elements[p]) * node.area /
                          (surface.offsets[p + 1] - surface.offsets[p]);
    for (std::uint32_t i = surface.offsets[p]; isSeen[node.patch] && i < surface.offsets[p + 1];
         ++i)
    {
      GatherPoint& point = points[surface.indices[i]];
      point.patch = std::min(point.patch, node.patch);
      point.point = surface.points[surface.indices[i]];
      point.weight += weight;
    }
  }
  PointsInView found;
  for (std::uint32_t id = 0; id < points.size(); ++id)
  {
    if (points[id].patch != None)
    {
      found.points.push_back(points[id]);
      found.ids.push_back(id);
    }
  }
  return found;
}

std::vector<Color> MeansOfElements(const GatheredMesh& mesh, const RadianceSolution& solution)
{
  std::vector<Color> radiance;
  for (const NodeId element : mesh.surface.elements)
  {
    const Node& node = mesh.tree[element];
    const auto leaf = solution.LeafAt(node.patch, node.centre);
    radiance.push_back(solution.emission[node.patch] + solution.elements[leaf].reflected);
  }
  return PointValues(mesh.surface, radiance);
}

/// Spread over the image: each stands for as many of the samples.
std::vector<ViewSample> ChooseJudges(const std::vector<ViewSample>& view, std::uint64_t seed)
{
  std::vector<ViewSample> judges;
  const std::size_t count = std::min(Judges, view.size());
  for (std::size_t k = 0; k < count; ++k)
  {
    // Not every n-th: that would be a pattern of rows and columns.
    const double place = (k + ToUnit(Hash(seed, k))) / count;
    judges.push_back(view[static_cast<std::size_t>(place * view.size())]);
  }
  return judges;
}

/// Relative L1 between the interpolated radiance at the judges and the one they have.
double InterpolationError(
  const GatheredMesh& mesh, const std::vector<ViewSample>& judges, const Color* radiance)
{
  const SurfaceInterpolator interpolator(mesh.tree, mesh.surface);
  double error = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < judges.size(); ++k)
  {
    const Color found = interpolator.At(mesh.pointRadiance, judges[k].patch, judges[k].point);
    error += judges[k].weight * Mean(glm::abs(found - radiance[k]));
    all += judges[k].weight * Mean(radiance[k]);
  }
  return all > 0.0 ? error / all : 0.0;
}

/// Gathers at the points, and at the judges, whose light is so known without interpolation.
void LightPoints(const SurfaceGather& gather, const RadianceSolution& solution,
  const std::vector<ViewSample>& view, const MeshGatherSettings& settings, GatheredMesh& mesh)
{
  PointsInView inView = FindPoints(mesh, view);
  mesh.gathered = std::move(inView.ids);
  const std::size_t count = inView.points.size();
  const std::vector<ViewSample> judges = ChooseJudges(view, settings.seed);
  for (const ViewSample& judge : judges)
  {
    inView.points.push_back({ judge.patch, judge.point, 0.0 });
  }
  const SurfaceGather::Result light =
    gather.Radiance(inView.points, { settings.gatherError, settings.seed });
  mesh.pointRadiance = MeansOfElements(mesh, solution);
  for (std::size_t k = 0; k < count; ++k)
  {
    mesh.pointRadiance[mesh.gathered[k]] = light.radiance[k];
  }
  mesh.irradiance.assign(light.irradiance.begin(), light.irradiance.begin() + count);
  mesh.interpolationError = InterpolationError(mesh, judges, light.radiance.data() + count);
  mesh.gatherError = light.error;
  mesh.counts.Add(light.counts);
}

} // namespace

void MeshGatherSettings::Validate() const
{
  for (const auto& [name, value] :
    { std::make_pair("interpolation error", this->interpolationError),
      std::make_pair("gather error", this->gatherError) })
  {
    if (!(value >= LeastGatherError && value <= 1.0))
    {
      throw InputError("mesh: " + std::string(name) + " is " + std::to_string(value) +
                       "; give a number from 0.0005 to 1");
    }
  }
}

GatheredMesh GatherMesh(const OccluderScene& occluders, const RadianceSolution& solution,
  const FacetSet& facets, ElementTree tree, const std::vector<ViewSample>& view,
  const MeshGatherSettings& settings)
{
  settings.Validate();
  const SurfaceGather gather(occluders, solution);
  GatherCounts counts;
  ElementTree refined =
    RefineForView(gather, solution, std::move(tree), view, settings.interpolationError, counts);
  ElementSurface surface = PatchMesh(refined, facets).Surface();
  GatheredMesh mesh{ std::move(refined), std::move(surface), {}, {}, {}, 0.0, 0.0, counts };
  LightPoints(gather, solution, view, settings, mesh);
  return mesh;
}

} // namespace vantage
