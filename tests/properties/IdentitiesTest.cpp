#include "core/math/Polygon.h"
#include "core/mesh/ContactCuts.h"
#include "core/reference/DenseSolve.h"
#include "properties/Found.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>

/// \file IdentitiesTest.cpp
/// What must hold of any scene, on a thousand of them: a third are open, a tenth symmetric.
///
/// On every scene every method is solved and held to
/// - agreement with the others, and a view flux that never falls nor exceeds the converged one (not
///   goal-oriented, which has links of its own and changes them);
/// - duality <V, L> = <E, P> (those that use importance).
/// What needs more solutions is held of one method a scene, each in its turn, or it would take a
/// minute:
/// - the same bits of radiance, importance and every step's report for any order of faces and for 1
///   and 2 threads, or 1 and 4, in turn;
/// - with one element a patch, the radiance equation on the interactions and the balance of energy
///   (not goal-oriented, some of whose links end at clusters);
/// - every fifth time, the dense solution, unless the panels of the scene touch.
///
/// A failure names its seed. That scene alone:
///
///     VANTAGE_SEED=712 out/build/tests/properties/test-properties --gtest_filter='*Identities*'
///
/// VANTAGE_SCENES is the number of scenes, 1000 unless said otherwise.

namespace vantage
{
namespace
{

constexpr std::uint64_t Blocks = 4;          ///< tests that can run side by side
constexpr std::uint64_t DenseEvery = 5;      ///< scenes; building the dense matrix is slow
constexpr double Unshot = 1e-10;             ///< part of the light at which methods stop
constexpr std::uint32_t VisibilityRays = 64; ///< where sampled visibility matters

/// \name Tolerances, by what causes the difference
///@{
/// Unshot, times what a view, all reflections, or a dim scene make of it.
constexpr double UnshotInView = 1e-7;
/// Unshot, all on one patch: where panels cut each other there are slivers.
constexpr double UnshotOnAPatch = 1e-5;
/// Goal-oriented ends its sweeps over links that it is going to refine.
constexpr double UnsolvedLinks = 0.03;
/// With one element a patch, the seen part of a patch and the kernel over it depend on each other;
/// rows of a closed scene are scaled to make up for it, at the cost of the columns.
constexpr double ClosedRows = 0.2;
/// Noise of VisibilityRays in the reflected light of the whole scene; a percent is usual.
constexpr double SampledShadows = 0.05;
///@}

std::uint64_t NumberFrom(const char* variable, std::uint64_t otherwise)
{
  const char* text = std::getenv(variable);
  return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

std::vector<std::uint64_t> SeedsOfBlock(std::uint64_t block)
{
  if (const std::uint64_t seed = NumberFrom("VANTAGE_SEED", 0))
  {
    return seed % Blocks == block ? std::vector<std::uint64_t>{ seed }
                                  : std::vector<std::uint64_t>{};
  }
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t seed = 1; seed <= NumberFrom("VANTAGE_SCENES", 1000); ++seed)
  {
    if (seed % Blocks == block)
    {
      seeds.push_back(seed);
    }
  }
  return seeds;
}

bool IsSymmetric(std::uint64_t seed)
{
  return seed % 10 == 7;
}

bool IsOpen(std::uint64_t seed)
{
  return seed % 3 == 0 && !IsSymmetric(seed);
}

Scene SceneOf(std::uint64_t seed)
{
  if (IsSymmetric(seed))
  {
    return test::MakeSymmetricScene(seed);
  }
  return IsOpen(seed) ? test::MakeOpenRandomScene(seed) : test::MakeRandomScene(seed);
}

/// In turn, so that all meet open and closed scenes and both oracles.
Method MethodInTurn(std::uint64_t seed)
{
  const std::vector<std::string>& names = MethodNames();
  return MethodFromName(names[seed / 12 % names.size()]);
}

SolverSettings SettingsOf(std::uint64_t seed, Method method)
{
  SolverSettings settings =
    test::CoarseSettings(method, seed / 6 % 2 == 0 ? RefinementOracle::F : RefinementOracle::BF);
  settings.viewRays = 256;
  settings.visibilityRays = 4;
  settings.refinement.maximumLevel = 1;
  return settings;
}

/// One element a patch, so that elements and interactions are a dense system as they are.
SolverSettings PatchSettingsOf(std::uint64_t seed)
{
  const std::vector<std::string> names = FixedGraphMethodNames();
  SolverSettings settings = SettingsOf(seed, MethodFromName(names[seed / 12 % names.size()]));
  settings.refinement.maximumLevel = 0;
  settings.visibilityRays = VisibilityRays;
  return settings;
}

/// Goal-oriented makes some hundred links; the others converge.
Solver SolvedBy(const Scene& scene, const SolverSettings& settings)
{
  Budget budget;
  budget.error = settings.method == Method::GoalOriented ? 0.0 : Unshot;
  if (settings.method == Method::GoalOriented)
  {
    budget.steps = 2;
  }
  Solver solver = test::MakeSolver(scene, settings);
  solver.Run(budget);
  return solver;
}

/// Of radiances that are not much darker than the mean.
double LargestDifference(const std::vector<Color>& found, const std::vector<Color>& expected)
{
  Color sum(0.0);
  for (const Color& color : expected)
  {
    sum += color;
  }
  const double mean = Mean(sum) / static_cast<double>(expected.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    largest = std::max(largest,
      MaxChannel(glm::abs(found[i] - expected[i])) / std::max(mean, MaxChannel(expected[i])));
  }
  return largest;
}
void ExpectMonotoneFlux(const Solver& solver)
{
  const double converged = Mean(solver.ViewFluxOfRadiance());
  double before = 0.0;
  for (const StepReport& report : solver.History())
  {
    // Round-off of some thousand additions.
    ASSERT_GE(report.viewFlux, before * (1.0 - 1e-12)) << "step " << report.step;
    // What is unshot is in the estimate and not in the radiance, or not yet in either.
    ASSERT_LE(report.viewFlux, converged * (1.0 + UnshotInView)) << "step " << report.step;
    before = report.viewFlux;
  }
}

void ExpectDuality(const Solver& solver, double tolerance)
{
  const Color radiance = solver.ViewFluxOfRadiance();
  const Color importance = solver.ViewFluxOfImportance();
  const Color difference = glm::abs(importance - radiance);
  ASSERT_LE(MaxChannel(difference), tolerance * MaxChannel(radiance));
}

/// Of each method, in the order of MethodNames().
using Solutions = std::vector<test::Found>;

Solutions SolveByEveryMethod(std::uint64_t seed, const Scene& scene)
{
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  Solutions solutions;
  for (const std::string& name : MethodNames())
  {
    SCOPED_TRACE(name);
    const Method method = MethodFromName(name);
    const Solver solver = SolvedBy(scene, SettingsOf(seed, method));
    if (method == Method::GoalOriented)
    {
      ExpectDuality(solver, UnsolvedLinks);
    }
    else
    {
      ExpectMonotoneFlux(solver);
    }
    if (UsesImportance(method))
    {
      ExpectDuality(solver, UnshotInView);
    }
    solutions.push_back(test::FoundBy(solver));
  }
  return solutions;
}

void ExpectAgreement(const Solutions& solutions)
{
  for (const std::string& name : FixedGraphMethodNames())
  {
    const auto method = static_cast<std::size_t>(MethodFromName(name));
    ASSERT_LE(LargestDifference(solutions[method].radiance, solutions[0].radiance), UnshotOnAPatch)
      << name;
  }
}

/// With more threads and relabelled at once, which tells enough as long as all is well.
void ExpectSameBits(std::uint64_t seed, const Scene& scene, const Solutions& solutions)
{
  const Method method = MethodInTurn(seed);
  SCOPED_TRACE(NameOf(method));
  const test::Found& expected = solutions[static_cast<std::size_t>(method)];
  const auto isSame = [&](const std::vector<std::size_t>& order, int threads)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Solver solver = SolvedBy(test::Reordered(scene, order), SettingsOf(seed, method));
    return test::IsSame(test::FoundBy(solver), expected, order);
  };
  const int threads = seed % 2 == 0 ? 2 : 4;
  const std::vector<std::size_t> order = test::RandomOrder(seed, scene.PolygonCount());
  const testing::AssertionResult both = isSame(order, threads);
  if (both)
  {
    return;
  }
  std::vector<std::size_t> identity(order.size());
  std::iota(identity.begin(), identity.end(), 0u);
  EXPECT_TRUE(isSame(order, 1)) << "relabelled";
  EXPECT_TRUE(isSame(identity, threads)) << threads << " threads";
  FAIL() << "relabelled, " << threads << " threads: " << both.message();
}

double AreaOf(const ElementSurface& surface, std::size_t element)
{
  Polygon shape;
  for (std::uint32_t i = surface.offsets[element]; i < surface.offsets[element + 1]; ++i)
  {
    shape.Add(surface.points[surface.indices[i]]);
  }
  return Area(shape);
}

/// Of an element that is a whole patch, from the interactions alone.
struct Row
{
  double area = 0.0;
  double sum = 0.0;      ///< sum of G, m^2 sr
  Color received{ 0.0 }; ///< sum of G L, W
  double closure = 1.0;  ///< what the solver scales that by (transport/Closure.h)
};

std::vector<Row> RowsOf(const Solver& solver, const ElementSolution& elements)
{
  std::map<PatchId, std::size_t> elementOf;
  std::vector<Row> rows(elements.radiance.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    elementOf[elements.patch[k]] = k;
    rows[k].area = AreaOf(elements.surface, k);
  }
  for (const InteractionRecord& link : solver.Interactions())
  {
    const std::size_t a = elementOf.at(link.shooter);
    const std::size_t b = elementOf.at(link.receiver);
    const double throughput = link.formFactor * rows[a].area;
    rows[a].sum += throughput;
    rows[b].sum += throughput;
    rows[a].received += throughput * elements.radiance[b];
    rows[b].received += throughput * elements.radiance[a];
  }
  return rows;
}

/// Every patch reflects what its interactions bring, once. Whether a patch is enclosed, and so
/// closed, is found by rays: told from which of both the radiance is.
void ExpectRadianceEquation(const ElementSolution& elements, std::vector<Row>& rows)
{
  const double mean =
    Mean(std::accumulate(elements.radiance.begin(), elements.radiance.end(), Color(0.0))) /
    static_cast<double>(rows.size());
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    Row& row = rows[k];
    const auto error = [&](double closure)
    {
      const Color expected =
        elements.emission[k] + elements.albedo[k] / Pi * closure * row.received / row.area;
      return MaxChannel(glm::abs(elements.radiance[k] - expected));
    };
    const double closure = row.sum > 0.0 ? std::clamp(Pi * row.area / row.sum, 0.6, 1.6) : 1.0;
    row.closure = error(closure) < error(1.0) ? closure : 1.0;
    const double size = std::max(mean, MaxChannel(elements.radiance[k]));
    ASSERT_LE(error(row.closure), UnshotOnAPatch * size) << "patch " << k;
  }
}

/// Power that is emitted is absorbed or escapes: what row sums lack of pi. What closure adds is
/// counted as emitted, and in a closed scene balances what is sent and not received.
void ExpectEnergyBalance(
  std::uint64_t seed, const ElementSolution& elements, const std::vector<Row>& rows)
{
  double emitted = 0.0;
  double added = 0.0;
  double absorbed = 0.0;
  double escaped = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const Row& row = rows[k];
    emitted += Pi * row.area * Mean(elements.emission[k]);
    added += (row.closure - 1.0) * Mean(row.received);
    absorbed += Pi * row.area *
                Mean((elements.radiance[k] - elements.emission[k]) *
                     (Color(1.0) / elements.albedo[k] - Color(1.0)));
    escaped += (Pi * row.area - row.sum) * Mean(elements.radiance[k]);
  }
  ASSERT_NEAR((absorbed + escaped) / (emitted + added), 1.0, UnshotInView);
  if (!IsOpen(seed))
  {
    ASSERT_NEAR(absorbed / emitted, 1.0, ClosedRows);
  }
}

/// What each side of each polygon is worth, by LU; nothing when polygons touch, which the solver
/// cuts there, so that its elements are others.
std::vector<Color> DenseRadiance(const Scene& scene)
{
  const FacetSet facets = BuildFacets(scene);
  if (CutAtContacts(facets).facets.size() != facets.facets.size())
  {
    return {};
  }
  DenseSettings settings;
  settings.exactVisibility = false;
  settings.rays = VisibilityRays;
  const DenseSolution dense = SolveDense(scene, settings);
  std::vector<Color> radiance(2 * scene.PolygonCount(), Color(0.0));
  for (std::size_t i = 0; i < dense.elements.size(); ++i)
  {
    const Patch& patch = dense.tree.PatchOfNode(dense.elements[i]);
    const std::uint32_t polygon = facets.facets[patch.facet].scenePolygon;
    radiance[2 * polygon + (patch.side == Side::Back)] = dense.radiance[i];
  }
  return radiance;
}

/// L1, relative, of the sides that emit nothing.
double ReflectedDifference(
  const Scene& scene, const std::vector<Color>& found, const std::vector<Color>& expected)
{
  double difference = 0.0;
  double sum = 0.0;
  for (std::size_t side = 0; side < expected.size(); ++side)
  {
    const Material& material = scene.materials[scene.materialOfPolygon[side / 2]];
    if (side % 2 == 1 || material.emission == Color(0.0))
    {
      difference += Mean(glm::abs(found[side] - expected[side]));
      sum += Mean(expected[side]);
    }
  }
  return difference / sum;
}

void ExpectDenseSystem(std::uint64_t seed, const Scene& scene)
{
  const Solver solver = SolvedBy(scene, PatchSettingsOf(seed));
  SCOPED_TRACE(NameOf(solver.Settings().method) + ", an element a patch");
  const ElementSolution elements = solver.Elements();
  std::vector<Row> rows = RowsOf(solver, elements);
  ExpectRadianceEquation(elements, rows);
  ExpectEnergyBalance(seed, elements, rows);
  const std::vector<Color> dense =
    seed % DenseEvery == 0 ? DenseRadiance(scene) : std::vector<Color>();
  if (!dense.empty())
  {
    const double difference =
      ReflectedDifference(scene, test::RadianceOfPolygonSides(solver), dense);
    ASSERT_LE(difference, IsOpen(seed) ? SampledShadows : ClosedRows) << "dense";
  }
}

class Identities : public testing::TestWithParam<std::uint64_t>
{
};

TEST_P(Identities, HoldOnEveryScene)
{
  for (const std::uint64_t seed : SeedsOfBlock(GetParam()))
  {
    SCOPED_TRACE("run again with VANTAGE_SEED=" + std::to_string(seed));
    const Scene scene = SceneOf(seed);
    const Solutions solutions = SolveByEveryMethod(seed, scene);
    ExpectAgreement(solutions);
    ExpectSameBits(seed, scene, solutions);
    ExpectDenseSystem(seed, scene);
    if (HasFatalFailure())
    {
      return; // One seed is enough to start from.
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Block, Identities, testing::Range<std::uint64_t>(0, Blocks));

} // namespace
} // namespace vantage
