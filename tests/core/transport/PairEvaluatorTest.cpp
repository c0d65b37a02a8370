#include "core/transport/PairEvaluator.h"

#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

class PairEvaluatorOfLitBox : public testing::Test
{
protected:
  PairEvaluatorOfLitBox()
    : Box(test::MakeLitBox())
    , Facets(BuildFacets(Box))
    , Occluders(Facets)
    , Tree(Facets, Box.materials)
    , Evaluator(Occluders, Accuracy::Default, 16)
  {
  }

  std::vector<NodeId> PatchNodes() const
  {
    std::vector<NodeId> nodes;
    for (const Patch& patch : this->Tree.Patches())
    {
      if (patch.IsActive())
      {
        nodes.push_back(patch.node);
      }
    }
    return nodes;
  }

  Scene Box;
  FacetSet Facets;
  OccluderScene Occluders;
  ElementTree Tree;
  PairEvaluator Evaluator;
};

TEST_F(PairEvaluatorOfLitBox, IsTheSameForEitherOrderOfTheEnds)
{
  std::size_t partlyVisible = 0;
  for (const NodeId a : this->PatchNodes())
  {
    for (const NodeId b : this->PatchNodes())
    {
      const PairValue ab = this->Evaluator.Evaluate(this->Tree, { a, b });
      const PairValue ba = this->Evaluator.Evaluate(this->Tree, { b, a });
      EXPECT_EQ(ab.throughput, ba.throughput);
      EXPECT_EQ(ab.visibility, ba.visibility);
      partlyVisible += ab.visibility > 0.0 && ab.visibility < 1.0 ? 1 : 0;
    }
  }
  EXPECT_GT(partlyVisible, 4u);
}

TEST_F(PairEvaluatorOfLitBox, ACertificateSavesTheRaysOfTheChildren)
{
  ElementPair pair{ this->PatchNodes()[0], this->PatchNodes()[1] };
  pair.parentVisibility = 0.25;
  pair.parentAgreeingRays = CertifyingRays;
  for (const NodeId a : this->PatchNodes())
  {
    for (const NodeId b : this->PatchNodes())
    {
      pair.first = a;
      pair.second = b;
      const PairValue value = this->Evaluator.Evaluate(this->Tree, pair);
      EXPECT_EQ(value.rays, 0u);
      if (FaceEachOther(this->Tree.Shape(a), this->Tree.Shape(b)))
      {
        EXPECT_EQ(value.visibility, 0.25);
        EXPECT_EQ(value.throughput,
          0.25 * Throughput(this->Tree.Shape(a), this->Tree.Shape(b), Accuracy::Default));
      }
    }
  }
}

TEST(FaceEachOther, KnowsFrontFromBack)
{
  const Polygon floor{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const Polygon wall{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
  const Polygon below{ { 0, 0, -1 }, { 1, 0, -1 }, { 1, 1, -1 }, { 0, 1, -1 } };
  EXPECT_TRUE(FaceEachOther(floor, wall));
  EXPECT_FALSE(FaceEachOther(floor, Reversed(wall)));
  EXPECT_FALSE(FaceEachOther(floor, floor));
  EXPECT_FALSE(FaceEachOther(floor, Reversed(floor)));
  EXPECT_FALSE(FaceEachOther(floor, below));
  EXPECT_TRUE(FaceEachOther(Reversed(floor), below));
}

} // namespace
} // namespace vantage
