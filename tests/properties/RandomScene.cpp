#include "properties/RandomScene.h"

#include "core/math/Polygon.h"
#include "core/math/Sampling.h"
#include "support/TestScenes.h"

#include <numeric>

namespace vantage::test
{

namespace
{

Color RandomColor(RandomStream& random, double low, double high)
{
  const auto channel = [&]() { return low + (high - low) * random.Next(); };
  const double red = channel();
  const double green = channel();
  return { red, green, channel() };
}

/// A flat panel in a random frame that stays well inside the unit box.
std::vector<Vec3> RandomPanel(RandomStream& random)
{
  const Vec3 centre(
    0.3 + 0.4 * random.Next(), 0.3 + 0.4 * random.Next(), 0.3 + 0.4 * random.Next());
  const double height = 2.0 * random.Next() - 1.0;
  const double turn = 2.0 * Pi * random.Next();
  const double ring = std::sqrt(1.0 - height * height);
  const Frame frame(Vec3(ring * std::cos(turn), ring * std::sin(turn), height));
  const double width = 0.05 + 0.15 * random.Next();
  const double depth = 0.05 + 0.15 * random.Next();
  std::vector<Vec3> corners{ centre - width * frame.x - depth * frame.y,
    centre + width * frame.x - depth * frame.y, centre + width * frame.x + depth * frame.y };
  if (random.Next() < 0.6)
  {
    corners.push_back(centre - width * frame.x + depth * frame.y);
  }
  return corners;
}

} // namespace

Scene MakeRandomScene(std::uint64_t seed)
{
  RandomStream random(seed);
  Scene scene;
  for (int m = 0; m < 4; ++m)
  {
    scene.materials.push_back(MakeMaterial(RandomColor(random, 0.1, 0.8)));
  }
  const auto anyMaterial = [&]() { return static_cast<std::uint32_t>(4.0 * random.Next()); };
  std::array<std::uint32_t, 6> faces;
  for (std::uint32_t& face : faces)
  {
    face = anyMaterial();
  }
  AddBox(scene, Vec3(0.0), Vec3(1.0), true, faces);
  const int panels = 1 + static_cast<int>(4.0 * random.Next());
  for (int p = 0; p < panels; ++p)
  {
    const bool emits = p == 0 || random.Next() < 0.3;
    scene.materials.push_back(MakeMaterial(
      RandomColor(random, 0.1, 0.8), emits ? RandomColor(random, 1.0, 20.0) : Color(0.0), true));
    scene.AddPolygon(RandomPanel(random), static_cast<std::uint32_t>(scene.materials.size() - 1));
  }
  scene.cameras.push_back(InsideCamera());
  return scene;
}

Scene MakeOpenRandomScene(std::uint64_t seed)
{
  constexpr std::size_t Ceiling = 1;
  const Scene closed = MakeRandomScene(seed);
  std::vector<std::size_t> kept(closed.PolygonCount());
  std::iota(kept.begin(), kept.end(), 0u);
  kept.erase(kept.begin() + Ceiling);
  return Reordered(closed, kept);
}

Scene MakeSymmetricScene(std::uint64_t seed)
{
  RandomStream random(seed);
  Scene scene;
  scene.materials = { MakeMaterial(RandomColor(random, 0.1, 0.8)),
    MakeMaterial(RandomColor(random, 0.1, 0.8), RandomColor(random, 1.0, 20.0), true) };
  AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  const double half = 0.05 + 0.3 * random.Next();
  const double z = 0.3 + 0.4 * random.Next();
  const double low = 0.5 - half;
  const double high = 0.5 + half;
  scene.AddPolygon(
    { Vec3(low, low, z), Vec3(low, high, z), Vec3(high, high, z), Vec3(high, low, z) }, 1);
  scene.cameras.push_back(InsideCamera());
  return scene;
}

std::vector<std::size_t> RandomOrder(std::uint64_t seed, std::size_t count)
{
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  RandomStream random(seed, 99u);
  for (std::size_t i = count; i > 1; --i)
  {
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.Next() * i)]);
  }
  return order;
}

Scene Reordered(const Scene& scene, const std::vector<std::size_t>& order)
{
  Scene reordered;
  reordered.materials = scene.materials;
  reordered.cameras = scene.cameras;
  for (const std::size_t p : order)
  {
    reordered.AddPolygon(CornersOf(scene, p), scene.materialOfPolygon[p]);
  }
  return reordered;
}

SolverSettings CoarseSettings(Method method, RefinementOracle oracle)
{
  SolverSettings settings;
  settings.method = method;
  settings.refinement.oracle = oracle;
  settings.refinement.formFactorTolerance = 0.3;
  settings.refinement.powerTolerance = 3e-2;
  settings.refinement.shadowTolerance = 1e-2;
  settings.refinement.minimumElementSize = 0.3;
  settings.viewRays = 1024;
  return settings;
}

Solver MakeSolver(const Scene& scene, const SolverSettings& settings)
{
  Solver solver(scene, settings);
  solver.SetCamera(scene.cameras[0]);
  return solver;
}

void Solve(Solver& solver, double error)
{
  Budget budget;
  budget.error = error;
  solver.Run(budget);
}

std::vector<Color> RadianceOfPolygonSides(const Solver& solver)
{
  const ElementSolution solution = solver.Elements();
  return MeansOverPolygonSides(solver, solution, solution.radiance);
}

std::vector<Color> MeansOverPolygonSides(
  const Solver& solver, const ElementSolution& solution, const std::vector<Color>& values)
{
  const std::size_t sides = 2 * solver.GetScene().PolygonCount();
  std::vector<Color> sums(sides, Color(0.0));
  std::vector<double> areas(sides, 0.0);
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const ElementSurface& surface = solution.surface;
    Vec3 areaNormal(0.0);
    const Vec3& first = surface.points[surface.indices[surface.offsets[i]]];
    for (std::uint32_t k = surface.offsets[i] + 2; k < surface.offsets[i + 1]; ++k)
    {
      areaNormal += glm::cross(
        surface.points[surface.indices[k - 1]] - first, surface.points[surface.indices[k]] - first);
    }
    const std::size_t side = 2 * solution.scenePolygon[i] + (solution.side[i] == Side::Back);
    const double area = 0.5 * glm::length(areaNormal);
    sums[side] += area * values[i];
    areas[side] += area;
  }
  for (std::size_t s = 0; s < sides; ++s)
  {
    sums[s] /= areas[s] > 0.0 ? areas[s] : 1.0;
  }
  return sums;
}

} // namespace vantage::test
