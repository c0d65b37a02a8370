#include "core/view/NamedLamps.h"

#include "core/view/GatherStage.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::GatherStage;

/// A floor, a globe, and a square lamp of the same material that was cut into two triangles.
Scene MakeTwoLamps()
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Color(0.5), Color(0.0), false);
  const std::uint32_t lamp = AddMaterial(scene, Color(0.0), Color(3.0), false);
  scene.AddPolygon({ { -2, -2, 0 }, { 2, -2, 0 }, { 2, 2, 0 }, { -2, 2, 0 } }, grey);
  test::AddBall(scene, { 0.5, 0.0, 1.0 }, 0.2, 8, lamp);
  scene.AddPolygon({ { -1, 0, 1 }, { -1, 1, 1 }, { 0, 1, 1 } }, lamp);
  scene.AddPolygon({ { -1, 0, 1 }, { 0, 1, 1 }, { 0, 0, 1 } }, lamp);
  return scene;
}

struct Named
{
  GatherStage stage{ MakeTwoLamps(), [](PatchId) { return Color(0.0); } };
  RadianceSolution::NodeIndex floor = 0;

  Named()
  {
    for (PatchId p = 0; p < this->stage.tree.Patches().size(); ++p)
    {
      if (this->stage.facets.facets[p / 2].material == 0 && this->stage.Normal(p).z > 0.5)
      {
        this->floor = this->stage.solution.elementOfPatch[p];
      }
    }
  }
  NamedLamps Lamps() const { return { this->stage.occluders, this->stage.solution }; }
};

TEST(NamedLamps, JoinsWhatWasCut)
{
  const Named named;
  const NamedLamps lamps = named.Lamps();
  ASSERT_EQ(lamps.Size(), 2u);
  EXPECT_EQ(lamps.Of(named.floor), NamedLamps::List({ 0, 1 }));
  std::vector<std::size_t> sizes;
  std::vector<PatchId> all;
  for (std::uint32_t k = 0; k < 2; ++k)
  {
    const NamedLamp& lamp = lamps[k];
    sizes.push_back(lamp.patches.size());
    all.insert(all.end(), lamp.patches.begin(), lamp.patches.end());
    EXPECT_EQ(lamp.emission, Color(3.0));
    EXPECT_EQ(lamp.surface.Size(), lamp.patches.size());
    EXPECT_EQ(lamp.convexPart, lamp.whole);
    for (const PatchId patch : lamp.patches)
    {
      EXPECT_TRUE(lamp.IsOfConvexPart(patch / 2));
    }
  }
  std::sort(sizes.begin(), sizes.end());
  EXPECT_EQ(sizes, (std::vector<std::size_t>{ 2, 224 }));
  std::sort(all.begin(), all.end());
  EXPECT_EQ(all, named.stage.solution.lamps);
}

/// A part of a lamp that an element names is a lamp of that, and still hidden by nothing of it.
TEST(NamedLamps, WhatIsNotNamedShinesNot)
{
  Named named;
  named.stage.solution.elements[named.floor].lastLamp = 10;
  const NamedLamps lamps = named.Lamps();
  std::size_t patches = 0;
  for (const std::uint32_t k : lamps.Of(named.floor))
  {
    patches += lamps[k].patches.size();
    EXPECT_GE(lamps[k].convexPart.size(), lamps[k].patches.size());
  }
  EXPECT_EQ(patches, 10u);
  named.stage.solution.elements[named.floor].lastLamp = 0;
  EXPECT_TRUE(named.Lamps().Of(named.floor).empty());
}

} // namespace
} // namespace vantage
