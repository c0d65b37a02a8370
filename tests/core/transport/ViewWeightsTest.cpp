#include "core/transport/ViewWeights.h"

#include "core/math/Sampling.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

std::vector<ViewSample> RandomSamples(const ElementTree& tree, RandomStream& random)
{
  std::vector<ViewSample> samples;
  for (PatchId p = 0; p < tree.Patches().size(); ++p)
  {
    for (int i = 0; tree.Patches()[p].IsActive() && i < 200; ++i)
    {
      samples.push_back(
        { p, PointAt(tree.Shape(tree.Patches()[p].node), random.Next2()), random.Next() });
    }
  }
  return samples;
}

TEST(ViewWeights, SplittingBeforeOrAfterIsTheSame)
{
  const Scene scene = test::MakeFurnace(Color(0.5));
  RandomStream random(7);
  ElementTree tree(BuildFacets(scene), scene.materials);
  const std::vector<ViewSample> samples = RandomSamples(tree, random);
  ViewWeights followed;
  followed.Set(tree, samples);
  for (int split = 0; split < 60; ++split)
  {
    const ViewSample& at = samples[static_cast<std::size_t>(random.Next() * samples.size())];
    const NodeId leaf = tree.LeafContaining(tree.Patches()[at.patch].node, at.point);
    tree.Split(leaf);
    followed.FollowSplit(tree, leaf);
  }
  ViewWeights fresh;
  fresh.Set(tree, samples);
  double total = 0.0;
  for (const ViewSample& sample : samples)
  {
    total += sample.weight;
  }
  double sumOfLeaves = 0.0;
  for (NodeId node = 0; node < tree.Size(); ++node)
  {
    if (!tree[node].IsCluster())
    {
      // Round-off of sums of a few hundred numbers, in different orders.
      ASSERT_NEAR(followed.Value(tree, node), fresh.Value(tree, node), 1e-9);
      sumOfLeaves += tree[node].IsLeaf() ? tree[node].area * fresh.Value(tree, node) : 0.0;
    }
  }
  EXPECT_NEAR(sumOfLeaves, total, 1e-10 * total);
}

} // namespace
} // namespace vantage
