#include "core/reference/LampTree.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/Sampling.h"
#include "core/reference/TestRooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace vantage
{
namespace
{

using namespace testing;

/// Lamps of different sizes and powers, turned at random.
Scene ScatteredLamps(int count)
{
  Scene scene;
  for (int i = 0; i < count; ++i)
  {
    RandomStream random(31, i);
    const Vec3 corner = Vec3(random.Next2(), random.Next()) * 10.0;
    const Frame frame(glm::normalize(Vec3(random.Next2(), random.Next()) - 0.5));
    const double size = 0.05 + 0.3 * random.Next();
    scene.materials.push_back(Diffuse(Color(0.0), Color(random.Next() + 0.1)));
    scene.AddPolygon({ corner, corner + size * frame.x, corner + size * (frame.x + frame.y),
                       corner + size * frame.y },
      i);
  }
  return scene;
}

TEST(LampTree, ProbabilitiesAddUpToOneAndMatchFrequencies)
{
  const Scene scene = ScatteredLamps(40);
  const FacetSet facets = BuildFacets(scene);
  const LampTree lamps(scene, facets);
  ASSERT_EQ(lamps.Size(), 40u);
  std::map<const Lamp*, double> probability;
  std::map<const Lamp*, int> count;
  const int n = 200000;
  int deadEnds = 0; // where the estimate of a node promised more than its children hold
  for (int i = 0; i < n; ++i)
  {
    const auto choice = lamps.Choose({ 5, 5, 5 }, { 0, 0, 1 }, (i + 0.5) / n);
    if (!choice)
    {
      ++deadEnds;
      continue;
    }
    ++count[choice->lamp];
    const auto [entry, isNew] = probability.emplace(choice->lamp, choice->probability);
    ASSERT_TRUE(isNew || std::abs(entry->second - choice->probability) < 1e-12);
  }
  double sum = 0.0;
  for (const auto& [lamp, p] : probability)
  {
    sum += p;
    // Evenly spaced numbers hit an interval of length p n times, give or take one.
    EXPECT_NEAR(count[lamp], p * n, 1.5);
  }
  // Lamps that are chosen less often than once in n may be missing.
  EXPECT_NEAR(sum + static_cast<double>(deadEnds) / n, 1.0, 80.0 / n);
  // Dead ends cost samples, not correctness; lamps turned at random are the worst case.
  EXPECT_GT(sum, 0.5);
}

TEST(LampTree, EveryLampThatLightsThePointHasAChance)
{
  const Scene scene = ScatteredLamps(60);
  const FacetSet facets = BuildFacets(scene);
  const LampTree lamps(scene, facets);
  for (std::uint64_t k = 0; k < 200; ++k)
  {
    SCOPED_TRACE("point " + std::to_string(k));
    RandomStream random(77, k);
    const Vec3 x = Vec3(random.Next2(), random.Next()) * 10.0;
    const Vec3 n = glm::normalize(Vec3(random.Next2(), random.Next()) - 0.5);
    double light = 0.0;
    for (const Facet& facet : facets.facets)
    {
      light += scene.materials[facet.material].emission.x * PointToPolygon(x, n, facet.shape);
    }
    // The irradiance is the mean of emission times form factor over probability.
    double estimate = 0.0;
    double squares = 0.0;
    const int draws = 4096;
    for (int i = 0; i < draws; ++i)
    {
      const auto choice = lamps.Choose(x, n, (i + random.Next()) / draws);
      const double value = choice
                             ? choice->lamp->emission.x *
                                 PointToPolygon(x, n, choice->lamp->shape) / choice->probability
                             : 0.0;
      estimate += value / draws;
      squares += value * value / draws;
    }
    // Six standard errors of independent draws; stratified ones do better. Fixed seeds.
    const double error = std::sqrt(std::max(0.0, squares - estimate * estimate) / draws);
    EXPECT_NEAR(estimate, light, 6.0 * error + 1e-12);
  }
}

TEST(LampTree, LampsThatTurnTheirBacksAreNotChosen)
{
  Scene scene;
  scene.materials = { Diffuse(Color(0.5), Color(1.0)) };
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 0); // shines to +z
  const LampTree lamps(scene, BuildFacets(scene));
  EXPECT_TRUE(lamps.Choose({ 0.5, 0.5, 5 }, { 0, 0, -1 }, 0.5));
  EXPECT_FALSE(lamps.Choose({ 0.5, 0.5, -5 }, { 0, 0, 1 }, 0.5));
  EXPECT_FALSE(lamps.Choose({ 0.5, 0.5, 5 }, { 0, 0, 1 }, 0.5));
}

TEST(LampTree, ASceneWithoutLampsHasNothingToChoose)
{
  const Scene scene = Furnace(Color(0.5), Color(0.0));
  EXPECT_FALSE(LampTree(scene, BuildFacets(scene)).Choose({ 1, 0.5, 1 }, { 0, 0, 1 }, 0.5));
}

} // namespace
} // namespace vantage
