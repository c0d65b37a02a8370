#include "core/view/MetElements.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// Patches of 1 m^2, the first of which has been split `levels` times in four, all of it.
RadianceSolution MakeSolution(std::uint32_t patches, int levels)
{
  RadianceSolution solution;
  solution.elements.resize(patches);
  for (RadianceSolution::Element& patch : solution.elements)
  {
    patch.area = 1.0;
  }
  std::vector<RadianceSolution::NodeIndex> leaves{ 0 };
  for (int level = 0; level < levels; ++level)
  {
    std::vector<RadianceSolution::NodeIndex> finer;
    for (const RadianceSolution::NodeIndex leaf : leaves)
    {
      const auto first = static_cast<RadianceSolution::NodeIndex>(solution.elements.size());
      solution.elements[leaf].firstChild = first;
      solution.elements[leaf].childCount = 4;
      for (std::uint32_t child = 0; child < 4; ++child)
      {
        RadianceSolution::Element element;
        element.area = 0.25 * solution.elements[leaf].area;
        solution.elements.push_back(element);
        finer.push_back(first + child);
      }
    }
    leaves = finer;
  }
  return solution;
}

TEST(MetElements, WhatFewRaysReachIsNotMetOften)
{
  const RadianceSolution solution = MakeSolution(4, 0);
  EXPECT_EQ(
    FindMetOften(solution, { 1000, 900, 9, 0 }), (std::vector<bool>{ true, true, false, false }));
  EXPECT_EQ(
    FindMetOften(solution, { 1000, 900, 11, 0 }), (std::vector<bool>{ true, true, true, false }));
}

TEST(MetElements, HowFinelyASurfaceIsCutMakesNoDifference)
{
  // As many rays on the first patch as on the second, one on every fourth of its 256 elements.
  const RadianceSolution solution = MakeSolution(2, 4);
  std::vector<std::uint32_t> hits(solution.elements.size(), 0);
  hits[1] = 64;
  std::uint32_t leaves = 0;
  for (RadianceSolution::NodeIndex id = 0; id < hits.size(); ++id)
  {
    if (id > 1 && solution.elements[id].childCount == 0)
    {
      hits[id] = leaves++ % 4 == 0 ? 1 : 0;
    }
  }
  const std::vector<bool> isMet = FindMetOften(solution, hits);
  for (RadianceSolution::NodeIndex id = 1; id < hits.size(); ++id)
  {
    EXPECT_TRUE(solution.elements[id].childCount > 0 || isMet[id]) << id;
  }
}

TEST(MetElements, AHalfOfASurfaceIsTold)
{
  // A floor under two rooms: rays of one of them, and a few through the door.
  const RadianceSolution solution = MakeSolution(1, 3);
  std::vector<std::uint32_t> hits(solution.elements.size(), 0);
  const auto quarterOf = [](RadianceSolution::NodeIndex leaf) { return (leaf - 21) / 16; };
  for (RadianceSolution::NodeIndex leaf = 21; leaf < hits.size(); ++leaf)
  {
    hits[leaf] = quarterOf(leaf) < 2 ? 20 : 0;
  }
  hits.back() = 5;
  const std::vector<bool> isMet = FindMetOften(solution, hits);
  for (RadianceSolution::NodeIndex leaf = 21; leaf < hits.size(); ++leaf)
  {
    EXPECT_EQ(isMet[leaf], quarterOf(leaf) < 2) << leaf;
  }
}

TEST(MetElements, NoHitsMeetNothing)
{
  EXPECT_EQ(FindMetOften(MakeSolution(2, 0), { 0, 0 }), (std::vector<bool>{ false, false }));
}

} // namespace
} // namespace vantage
