#include "core/transport/HierarchicalField.h"

#include "core/math/Sampling.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <map>

namespace vantage
{
namespace
{

/// The same by brute force: what each leaf has received, kept leaf by leaf.
class LeafByLeaf
{
public:
  explicit LeafByLeaf(const ElementTree& tree)
    : Tree(tree)
    , Received(tree.Size(), Color(0.0))
    , Weights(tree.Size(), 1.0)
  {
  }

  void Receive(NodeId node, const Color& amount)
  {
    for (const NodeId n : NodesOfPatch(this->Tree, node))
    {
      this->Received[n] += this->Tree[n].IsLeaf() ? amount : Color(0.0);
    }
  }
  void SetWeights(const std::vector<double>& weights) { this->Weights = weights; }

  Color Mean(NodeId node, bool isWeighted) const
  {
    Color sum(0.0);
    for (const NodeId n : NodesOfPatch(this->Tree, node))
    {
      if (this->Tree[n].IsLeaf())
      {
        sum += this->Tree[n].area * this->Received[n] * (isWeighted ? this->Weights[n] : 1.0);
      }
    }
    return sum / this->Tree[node].area;
  }

private:
  const ElementTree& Tree;
  std::vector<Color> Received;
  std::vector<double> Weights;
};

ElementTree RandomlySplitTree(RandomStream& random)
{
  const Scene scene = test::MakeFurnace(Color(0.5));
  ElementTree tree(BuildFacets(scene), scene.materials);
  for (int split = 0; split < 40; ++split)
  {
    const PatchId patch = static_cast<PatchId>(random.Next() * 6.0);
    const Patch& p = tree.Patches()[2 * patch];
    const Patch& back = tree.Patches()[2 * patch + 1];
    const NodeId root = p.IsActive() ? p.node : back.node;
    tree.Split(tree.LeafContaining(root, PointAt(tree.Shape(root), random.Next2())));
  }
  return tree;
}

TEST(HierarchicalField, AgreesWithKeepingEveryLeaf)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const ElementTree tree = RandomlySplitTree(random);
    HierarchicalField field;
    field.Follow(tree);
    LeafByLeaf slow(tree);
    const auto receiveSome = [&]()
    {
      for (int i = 0; i < 100; ++i)
      {
        const NodeId node = static_cast<NodeId>(random.Next() * tree.Size());
        if (!tree[node].IsCluster())
        {
          const Color amount(random.Next(), random.Next(), random.Next());
          field.Receive(tree, node, amount);
          slow.Receive(node, amount);
        }
      }
    };
    const auto compare = [&]()
    {
      for (NodeId node = 0; node < tree.Size(); ++node)
      {
        if (!tree[node].IsCluster())
        {
          // Round-off of sums of some hundred terms of size 1.
          const Color received = slow.Mean(node, false);
          const Color weighted = slow.Mean(node, true);
          ASSERT_NEAR(glm::length(field.Received(tree, node) - received), 0.0, 1e-11);
          ASSERT_NEAR(glm::length(field.Weighted(tree, node) - weighted), 0.0, 1e-11);
        }
      }
    };
    receiveSome();
    compare();
    std::vector<double> weights(tree.Size());
    for (double& weight : weights)
    {
      weight = 0.5 + random.Next();
    }
    slow.SetWeights(weights);
    for (const Patch& patch : tree.Patches())
    {
      if (patch.IsActive())
      {
        field.SetWeights(tree, patch.node, weights);
      }
    }
    compare();
    receiveSome();
    compare();
  }
}

TEST(HierarchicalField, NewElementsHaveWhatTheirParentHad)
{
  const Scene scene = test::MakeFurnace(Color(0.5));
  ElementTree tree(BuildFacets(scene), scene.materials);
  NodeId patch = None;
  for (const Patch& p : tree.Patches())
  {
    patch = p.IsActive() ? p.node : patch;
  }
  HierarchicalField field;
  field.Follow(tree);
  field.Receive(tree, patch, Color(1.0, 2.0, 3.0));
  const NodeId child = tree.Split(patch);
  field.Follow(tree);
  EXPECT_EQ(field.Received(tree, child), Color(1.0, 2.0, 3.0));
  field.Receive(tree, child, Color(4.0));
  EXPECT_EQ(field.Received(tree, child), Color(5.0, 6.0, 7.0));
  EXPECT_EQ(field.Received(tree, child + 1), Color(1.0, 2.0, 3.0));
  EXPECT_NEAR(field.Received(tree, patch).x, 2.0, 1e-15);
}

} // namespace
} // namespace vantage
