#include "core/transport/Closure.h"

#include "core/transport/Transport.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

struct Expanded
{
  explicit Expanded(const Scene& theScene, double formFactorTolerance = 0.1)
    : scene(theScene)
    , facets(BuildFacets(scene))
    , occluders(facets)
    , transport(ElementTree(facets, scene.materials), occluders,
        std::vector<PatchOptics>(2 * facets.facets.size()), facets.meanArea,
        Settings(formFactorTolerance))
  {
    for (PatchId p = 0; p < this->transport.Tree().Patches().size(); ++p)
    {
      if (this->transport.Tree().Patches()[p].IsActive())
      {
        this->transport.Expand(p, 0);
      }
    }
  }

  static TransportSettings Settings(double formFactorTolerance)
  {
    TransportSettings settings;
    settings.refinement.oracle = RefinementOracle::F;
    settings.refinement.formFactorTolerance = formFactorTolerance;
    settings.refinement.minimumElementSize = 0.1;
    return settings;
  }

  std::vector<double> FactorsOf(PatchId patch) const
  {
    return ClosureFactors(transport.Tree(), occluders, transport.Graph(), patch);
  }

  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  Transport transport;
};

TEST(Closure, PatchesOfAClosedBoxAreCompleteAndTheirElementsAreNot)
{
  // What the closure mends must be there: whole faces have row sums of pi, single elements not.
  const Expanded box(test::MakeFurnace(Color(0.5)));
  double largest = 0.0;
  for (const Patch& patch : box.transport.Tree().Patches())
  {
    if (!patch.IsActive())
    {
      continue;
    }
    const PatchId id = box.transport.Tree()[patch.node].patch;
    const std::vector<double> factors = box.FactorsOf(id);
    double rowSum = 0.0;
    for (const NodeId node : NodesOfPatch(box.transport.Tree(), patch.node))
    {
      if (box.transport.Tree()[node].IsLeaf())
      {
        rowSum += box.transport.Tree()[node].area / factors[node];
        largest = std::max(largest, std::abs(factors[node] - 1.0));
      }
    }
    // Form factors of default accuracy.
    EXPECT_NEAR(rowSum / box.transport.Tree()[patch.node].area, 1.0, 1e-5);
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_LT(largest, 0.4);
}

TEST(Closure, FinerInteractionsNeedLessOfIt)
{
  const auto spread = [](double tolerance)
  {
    const Expanded box(test::MakeFurnace(Color(0.5)), tolerance);
    double square = 0.0;
    for (const Patch& patch : box.transport.Tree().Patches())
    {
      for (const NodeId node :
        patch.IsActive() ? NodesOfPatch(box.transport.Tree(), patch.node) : std::vector<NodeId>{})
      {
        const PatchId id = box.transport.Tree()[patch.node].patch;
        const double error = box.FactorsOf(id)[node] - 1.0;
        square += box.transport.Tree()[node].IsLeaf()
                    ? error * error * box.transport.Tree()[node].area
                    : 0.0;
      }
    }
    return std::sqrt(square / 6.0);
  };
  const double coarse = spread(0.1);
  const double fine = spread(0.025);
  EXPECT_LT(fine, 0.6 * coarse) << coarse;
}

TEST(Closure, OpenPlacesAreLeftAlone)
{
  Scene scene = test::MakeFurnace(Color(0.5));
  scene.offsets.pop_back();
  scene.indices.resize(scene.offsets.back());
  scene.materialOfPolygon.pop_back();
  const Expanded open(scene);
  for (PatchId p = 0; p < open.transport.Tree().Patches().size(); ++p)
  {
    if (open.transport.Tree().Patches()[p].IsActive())
    {
      for (const double factor : open.FactorsOf(p))
      {
        EXPECT_EQ(factor, 1.0);
      }
    }
  }
}

} // namespace
} // namespace vantage
