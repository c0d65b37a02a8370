#include "core/transport/Refinement.h"

#include "core/Error.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

class RefinerOfBox : public testing::Test
{
protected:
  RefinerOfBox()
    : Box(test::MakeFurnace(Color(0.5)))
    , Tree(BuildFacets(Box), Box.materials)
  {
    for (const Patch& patch : this->Tree.Patches())
    {
      if (patch.IsActive())
      {
        this->Nodes.push_back(patch.node);
      }
    }
  }

  RefinementQuery Query(double power, double visibility, bool isDirect) const
  {
    return { this->Nodes[0], this->Nodes[1], 0.2 * Pi * visibility, visibility, power, isDirect };
  }

  Scene Box;
  ElementTree Tree;
  std::vector<NodeId> Nodes;
};

TEST_F(RefinerOfBox, FormFactorOracleLooksAtGeometryOnly)
{
  RefinementSettings settings;
  settings.oracle = RefinementOracle::F;
  settings.formFactorTolerance = 0.19;
  EXPECT_TRUE(Refiner(settings, 1.0).Choose(this->Tree, this->Query(0.0, 1.0, false)).Any());
  settings.formFactorTolerance = 0.21;
  EXPECT_FALSE(Refiner(settings, 1.0).Choose(this->Tree, this->Query(1.0, 1.0, true)).Any());
  // Partly hidden, the kernel still varies over the whole end.
  settings.formFactorTolerance = 0.19;
  EXPECT_TRUE(Refiner(settings, 1.0).Choose(this->Tree, this->Query(0.0, 0.1, false)).Any());
}

TEST_F(RefinerOfBox, PowerOracleSpendsOnWhatCarries)
{
  RefinementSettings settings;
  settings.formFactorTolerance = 0.1;
  settings.powerTolerance = 1e-2;
  settings.shadowTolerance = 1e-4;
  const Refiner refiner(settings, 1.0);
  // Faces of the unit box that share an edge are as far from each other as they are large.
  EXPECT_TRUE(refiner.Choose(this->Tree, this->Query(0.02, 1.0, false)).Any());
  EXPECT_FALSE(refiner.Choose(this->Tree, this->Query(0.005, 1.0, false)).Any());
  // Small ends far away from each other carry a constant kernel well.
  RefinementQuery far = this->Query(0.02, 1.0, false);
  for (int level = 0; level < 4; ++level)
  {
    far.first = this->Tree.Split(far.first);
    far.second = this->Tree.Split(far.second) + 2;
  }
  EXPECT_FALSE(refiner.Choose(this->Tree, far).Any());
  EXPECT_FALSE(refiner.Choose(this->Tree, this->Query(0.005, 0.5, false)).Any());
  EXPECT_TRUE(refiner.Choose(this->Tree, this->Query(0.005, 0.5, true)).Any());
  EXPECT_FALSE(refiner.Choose(this->Tree, this->Query(0.00005, 0.5, true)).Any());
}

TEST_F(RefinerOfBox, SplitsTheLargerEndAndStopsAtTheLimits)
{
  RefinementSettings settings;
  settings.oracle = RefinementOracle::F;
  settings.formFactorTolerance = 0.01;
  settings.minimumElementSize = 0.4;
  const Refiner refiner(settings, 1.0);
  const NodeId child = this->Tree.Split(this->Nodes[0]);
  RefinementQuery query{ child, this->Nodes[1], 0.05 * Pi, 1.0, 1.0, true };
  EXPECT_FALSE(refiner.Choose(this->Tree, query).first);
  EXPECT_TRUE(refiner.Choose(this->Tree, query).second);
  std::swap(query.first, query.second);
  EXPECT_TRUE(refiner.Choose(this->Tree, query).first);
  EXPECT_FALSE(refiner.Choose(this->Tree, query).second);
  // Ends of one size are split both: nothing depends on which is called the first.
  const SplitChoice both = refiner.Choose(this->Tree, this->Query(0.0, 1.0, false));
  EXPECT_TRUE(both.first && both.second);
  // Elements of edge 0.5 may not be split into 0.25.
  query.first = this->Tree.Split(this->Nodes[1]);
  EXPECT_FALSE(refiner.Choose(this->Tree, query).Any());
  settings.minimumElementSize = 0.2;
  settings.maximumLevel = 1;
  EXPECT_FALSE(Refiner(settings, 1.0).Choose(this->Tree, query).Any());
  settings.maximumLevel = 2;
  EXPECT_TRUE(Refiner(settings, 1.0).Choose(this->Tree, query).Any());
}

TEST(RefinementSettings, RefusesValuesOutOfRange)
{
  const auto refuses = [](auto&& change)
  {
    RefinementSettings settings;
    change(settings);
    EXPECT_THROW(settings.Validate(), InputError);
  };
  refuses([](RefinementSettings& s) { s.formFactorTolerance = 0.0; });
  refuses([](RefinementSettings& s) { s.formFactorTolerance = 1.5; });
  refuses([](RefinementSettings& s) { s.powerTolerance = -1.0; });
  refuses([](RefinementSettings& s) { s.shadowTolerance = std::nan(""); });
  refuses([](RefinementSettings& s) { s.minimumElementSize = 0.0; });
  refuses([](RefinementSettings& s) { s.maximumLevel = 21; });
  EXPECT_NO_THROW(RefinementSettings().Validate());
}

} // namespace
} // namespace vantage
