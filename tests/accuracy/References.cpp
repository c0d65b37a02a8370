#include "accuracy/References.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace vantage::test
{

namespace
{

/// Reflected radiance of a solution, drawn once into a square raster for each patch, so that
/// looking it up neither costs a search nor needs anything of the solver.
class ReflectedRadiance
{
public:
  ReflectedRadiance(const FacetSet& facets, const ElementSolution& solution)
    : Patches(2 * facets.facets.size())
  {
    for (std::uint32_t p = 0; p < this->Patches.size(); ++p)
    {
      this->Patches[p] = MakeRaster(facets.facets[p / 2].shape);
    }
    for (std::size_t k = 0; k < solution.radiance.size(); ++k)
    {
      this->Paint(solution, k);
    }
  }

  Color At(const Hit& hit) const
  {
    const Raster& raster = this->Patches[hit.Patch()];
    const Vec2 place = raster.Place(hit.point);
    const auto cell = [](double t)
    { return std::clamp(static_cast<int>(t * CellsAlong), 0, CellsAlong - 1); };
    return raster.cells[cell(place.y) * CellsAlong + cell(place.x)];
  }

private:
  static constexpr int CellsAlong = 32; ///< finer than what a mean over a hemisphere can tell

  struct Raster
  {
    Vec3 origin, u, v; ///< the rectangle is where both dot products are in [0, 1]
    std::vector<Color> cells;

    Vec2 Place(const Vec3& x) const
    {
      return { glm::dot(x - this->origin, this->u), glm::dot(x - this->origin, this->v) };
    }
  };

  /// The rectangle around a shape, along its first edge.
  static Raster MakeRaster(const Polygon& shape)
  {
    const Vec3 x = glm::normalize(shape[1] - shape[0]);
    const Vec3 y = glm::cross(UnitNormal(shape), x);
    Vec2 low(0.0);
    Vec2 high(0.0);
    for (const Vec3& corner : shape)
    {
      const Vec2 place(glm::dot(corner - shape[0], x), glm::dot(corner - shape[0], y));
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    return { shape[0] + low.x * x + low.y * y, x / (high.x - low.x), y / (high.y - low.y),
      std::vector<Color>(CellsAlong * CellsAlong, Color(0.0)) };
  }

  /// Gives its radiance to the cells whose centre lies in the rectangle around an element.
  void Paint(const ElementSolution& solution, std::size_t element)
  {
    Raster& raster = this->Patches[solution.patch[element]];
    Vec2 low(1.0);
    Vec2 high(0.0);
    const ElementSurface& surface = solution.surface;
    for (std::uint32_t i = surface.offsets[element]; i < surface.offsets[element + 1]; ++i)
    {
      const Vec2 place = raster.Place(surface.points[surface.indices[i]]);
      low = glm::min(low, place);
      high = glm::max(high, place);
    }
    const auto firstCell = [](double t)
    { return std::clamp(static_cast<int>(std::lround(t * CellsAlong)), 0, CellsAlong); };
    for (int y = firstCell(low.y); y < firstCell(high.y); ++y)
    {
      for (int x = firstCell(low.x); x < firstCell(high.x); ++x)
      {
        raster.cells[y * CellsAlong + x] = solution.radiance[element] - solution.emission[element];
      }
    }
  }

  std::vector<Raster> Patches;
};

/// A path tracer and the geometry it keeps references to.
struct Tracer
{
  explicit Tracer(const Scene& scene)
    : facets(BuildFacets(scene))
    , occluders(this->facets)
    , tracer(scene, this->facets, this->occluders)
  {
  }

  FacetSet facets;
  OccluderScene occluders;
  PathTracer tracer;
};

} // namespace

Solver Solved(
  const Scene& scene, const Camera& camera, const SolverSettings& settings, double error)
{
  Solver solver(scene, settings);
  solver.SetCamera(camera);
  Budget budget;
  budget.error = error;
  EXPECT_EQ(solver.Run(budget), RunEnd::Converged);
  return solver;
}

Camera SquareCamera(const Scene& scene, const std::string& name)
{
  Camera camera = scene.FindCamera(name);
  camera.aspect = 1.0;
  return camera;
}

Image GatheredImage(const Solver& fine, const Camera& camera, int size, int gatherRays)
{
  const Tracer tracer(fine.GetScene());
  const ReflectedRadiance reflected(tracer.facets, fine.Elements());
  PathTracerSettings settings;
  settings.samplesPerPixel = 1;
  settings.pixelCentres = true;
  settings.shadowRays = 144;
  settings.gatherRays = gatherRays;
  return tracer.tracer.Render(
    camera, size, size, settings, nullptr, [&](const Hit& hit) { return reflected.At(hit); });
}

void Record(const std::string& name, double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  testing::Test::RecordProperty(name, text);
  std::printf("accuracy: %s = %s\n", name.c_str(), text);
}

} // namespace vantage::test
