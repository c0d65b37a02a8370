#include "core/mesh/ElementTree.h"

#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::AddQuad;
using test::Named;

/// Triangles and quadrilaterals all over the place.
Scene Scattered(std::uint64_t seed, int count)
{
  RandomStream random(seed);
  Scene scene;
  scene.materials = { Named("two-sided"), Named("one-sided", false) };
  for (int i = 0; i < count; ++i)
  {
    scene.AddPolygon(test::RandomStar(random, 3 + i % 2, 1.0), i % 5 == 0 ? 1 : 0);
  }
  return scene;
}

ElementTree TreeOf(const Scene& scene, Sides sides = Sides::Both)
{
  return ElementTree(BuildFacets(scene), scene.materials, sides);
}

/// All promises about how the nodes hang together.
void ExpectSound(const ElementTree& tree)
{
  std::vector<double> areaBelow(tree.Size(), 0.0);
  std::vector<int> parents(tree.Size(), 0);
  std::size_t leaves = 0;
  for (NodeId id = tree.Size(); id-- > 0;)
  {
    const Node& node = tree[id];
    leaves += node.IsLeaf() ? 1 : 0;
    ASSERT_EQ(node.parent == None, id == tree.Root());
    ASSERT_TRUE(node.parent == None || node.parent < id);
    ASSERT_TRUE(!node.IsCluster() || node.childCount == 2);
    ASSERT_TRUE(node.IsCluster() || node.childCount == 0 || node.childCount == 4);
    for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child)
    {
      ASSERT_EQ(tree[child].parent, id);
      ++parents[child];
      if (!node.IsCluster())
      {
        ASSERT_EQ(tree[child].patch, node.patch);
        ASSERT_EQ(tree[child].level, node.level + 1);
      }
    }
    if (!node.IsLeaf())
    {
      // Round-off of a sum over all patches.
      ASSERT_NEAR(node.area, areaBelow[id], 1e-12 * node.area);
    }
    if (node.parent != None)
    {
      areaBelow[node.parent] += node.area;
    }
  }
  EXPECT_EQ(leaves, tree.LeafElementCount());
  EXPECT_EQ(std::count(parents.begin(), parents.end(), 1), tree.Size() - 1);
}

/// Corners of all nodes lie in the spheres of all that are above them.
void ExpectSpheresHold(const ElementTree& tree)
{
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    for (int i = 0; i < tree[id].cornerCount; ++i)
    {
      for (NodeId above = id; above != None; above = tree[above].parent)
      {
        const double distance = glm::length(tree[id].corners[i] - tree[above].centre);
        ASSERT_LE(distance, tree[above].radius * (1.0 + 1e-12)); // round-off
      }
    }
  }
}

TEST(ElementTree, NodesAreSmall)
{
  EXPECT_LE(sizeof(Node), 192u);
}

TEST(ElementTree, HangsTogether)
{
  for (const int count : { 1, 2, 3, 10, 500 })
  {
    SCOPED_TRACE(count);
    ElementTree tree = TreeOf(Scattered(count, count));
    ExpectSound(tree);
    ExpectSpheresHold(tree);
    RandomStream random(count);
    test::SplitAtRandom(tree, 300, random);
    ExpectSound(tree);
    ExpectSpheresHold(tree);
  }
}

TEST(ElementTree, EveryActivePatchHangsInItOnce)
{
  const Scene scene = Scattered(3, 200);
  const FacetSet facets = BuildFacets(scene);
  for (const auto sides : { Sides::Both, Sides::FrontOnly })
  {
    const ElementTree tree(facets, scene.materials, sides);
    ASSERT_EQ(tree.Patches().size(), 2 * facets.facets.size());
    std::size_t active = 0;
    for (PatchId p = 0; p < tree.Patches().size(); ++p)
    {
      const Patch& patch = tree.Patches()[p];
      const Facet& facet = facets.facets[p / 2];
      const bool isFront = p % 2 == 0;
      EXPECT_EQ(patch.facet, p / 2);
      EXPECT_EQ(patch.side, isFront ? Side::Front : Side::Back);
      EXPECT_EQ(patch.normal, UnitNormal(isFront ? facet.shape : Reversed(facet.shape)));
      ASSERT_EQ(patch.IsActive(),
        isFront || (sides == Sides::Both && scene.materials[facet.material].twoSided));
      if (patch.IsActive())
      {
        ++active;
        EXPECT_EQ(tree[patch.node].patch, p);
        EXPECT_EQ(tree[patch.node].level, 0);
        EXPECT_EQ(UnitNormal(tree.Shape(patch.node)), patch.normal);
      }
    }
    EXPECT_EQ(tree.Size(), 2 * active - 1);
    EXPECT_EQ(tree.LeafElementCount(), active);
  }
}

TEST(ElementTree, SinglePatchIsTheRoot)
{
  Scene scene;
  scene.materials.push_back(Named("one-sided", false));
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  const ElementTree tree = TreeOf(scene);
  EXPECT_EQ(tree.Size(), 1u);
  EXPECT_FALSE(tree[tree.Root()].IsCluster());
}

TEST(ElementTree, BackToBackPolygonsAreBothActiveEvenIfOneSided)
{
  Scene scene;
  scene.materials.push_back(Named("one-sided", false));
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  AddQuad(scene, { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 });
  EXPECT_EQ(TreeOf(scene, Sides::Both).LeafElementCount(), 2u);
  EXPECT_EQ(TreeOf(scene, Sides::FrontOnly).LeafElementCount(), 2u);
}

int Depth(const ElementTree& tree)
{
  std::vector<int> depth(tree.Size(), 0);
  for (NodeId id = 1; id < tree.Size(); ++id)
  {
    depth[id] = depth[tree[id].parent] + 1;
  }
  return *std::max_element(depth.begin(), depth.end());
}

TEST(ElementTree, DepthIsLogarithmicEvenWhenSizesDifferWildly)
{
  Scene scene;
  scene.materials.push_back(Named("wall"));
  for (int i = 0; i < 400; ++i)
  {
    const double size = std::pow(0.5, i);
    AddQuad(scene, { size, 0, 0 }, { 0.1 * size, 0, 0 }, { 0, 0.1 * size, 0 });
  }
  const ElementTree tree(BuildFacets(scene, 0.0), scene.materials);
  // Each cut leaves at most 7/8 of n items; below 8 items, at most n - 1.
  EXPECT_LE(Depth(tree), std::log(800.0 / 8.0) / std::log(8.0 / 7.0) + 8.0);
}

TEST(ElementTree, TheTwoSidesOfAWallPartEarly)
{
  // By centroid alone the two sides of every wall would be the last to part.
  const ElementTree tree = TreeOf(test::RoomGrid(8, 8));
  std::size_t partLast = 0;
  const std::size_t walls = tree.Patches().size() / 2;
  for (std::uint32_t f = 0; f < walls; ++f)
  {
    const NodeId front = tree.Patches()[PatchOf(f, Side::Front)].node;
    const NodeId back = tree.Patches()[PatchOf(f, Side::Back)].node;
    partLast += tree[front].parent == tree[back].parent ? 1 : 0;
  }
  EXPECT_LT(partLast, walls / 3);
}

TEST(ElementTree, WallsOfARoomStayTogether)
{
  const int n = 8;
  const ElementTree tree = TreeOf(test::RoomGrid(n, n));
  int clusters = 0;  // of six patches of area 1 at most
  int ofOneRoom = 0; // and those that hold sides of one room, or of one place outside
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    const Node& node = tree[id];
    if (!node.IsCluster() || node.area > 6.5)
    {
      continue;
    }
    ++clusters;
    bool isOneRoom = true;
    Vec3 room(-1e9);
    std::vector<NodeId> stack{ id };
    while (!stack.empty())
    {
      const Node& top = tree[stack.back()];
      stack.pop_back();
      for (NodeId c = top.firstChild; c < top.firstChild + top.childCount; ++c)
      {
        stack.push_back(c);
      }
      if (!top.IsCluster())
      {
        const Vec3 cell = glm::floor(top.centre + 0.1 * tree.Patches()[top.patch].normal);
        isOneRoom = isOneRoom && (room.x < -1e8 || cell == room);
        room = cell;
      }
    }
    ofOneRoom += isOneRoom ? 1 : 0;
  }
  EXPECT_GT(ofOneRoom, 0.5 * clusters);
}

Polygon RandomConvex(RandomStream& random, int corners)
{
  for (;;)
  {
    Polygon polygon;
    for (const Vec3& p : test::RandomStar(random, corners, 0.2))
    {
      polygon.Add(p);
    }
    bool isConvex = true;
    for (int i = 0; i < corners; ++i)
    {
      const Vec3 turn = glm::cross(polygon[(i + 1) % corners] - polygon[i],
        polygon[(i + 2) % corners] - polygon[(i + 1) % corners]);
      isConvex = isConvex && glm::dot(turn, UnitNormal(polygon)) > 0.01;
    }
    if (isConvex)
    {
      return polygon;
    }
  }
}

ElementTree TreeOfOne(const Polygon& polygon)
{
  Scene scene;
  scene.materials.push_back(Named("one-sided", false));
  scene.AddPolygon({ polygon.begin(), polygon.end() }, 0);
  return TreeOf(scene);
}

/// Distance of x from the inside of p, in its plane; 0 inside.
double DistanceOutside(const Polygon& p, const Vec3& x)
{
  double outside = 0.0;
  for (int i = 0; i < p.Size(); ++i)
  {
    const Vec3 edge = p[(i + 1) % p.Size()] - p[i];
    const Vec3 inward = glm::normalize(glm::cross(UnitNormal(p), edge));
    outside = std::max(outside, -glm::dot(x - p[i], inward));
  }
  return outside;
}

TEST(ElementTree, ChildrenPartTheirParent)
{
  for (std::uint64_t seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    ElementTree tree = TreeOfOne(RandomConvex(random, seed % 2 == 0 ? 3 : 4));
    const NodeId first = tree.Split(tree.Root());
    EXPECT_EQ(tree.Split(tree.Root()), first); // asking again changes nothing
    EXPECT_EQ(tree.Size(), 5u);
    const Polygon parent = tree.Shape(tree.Root());
    for (int i = 0; i < 4; ++i)
    {
      const Polygon child = tree.Shape(first + i);
      EXPECT_EQ(child.Size(), parent.Size());
      EXPECT_TRUE(i >= parent.Size() || child[i] == parent[i]);
      EXPECT_EQ(tree[first + i].area, Area(child));
      EXPECT_EQ(tree[first + i].centre, Centroid(child));
      EXPECT_GT(glm::dot(UnitNormal(child), UnitNormal(parent)), 1.0 - 1e-12);
    }
    // Round-off only: the pieces are those of the parent.
    double sum = 0.0;
    for (NodeId child = first; child < first + 4; ++child)
    {
      sum += tree[child].area;
    }
    EXPECT_NEAR(sum, tree[tree.Root()].area, 1e-13);
    for (int k = 0; k < 50; ++k)
    {
      const Vec3 x = PointAt(parent, random.Next2());
      const NodeId child = tree.ChildContaining(tree.Root(), x);
      ASSERT_TRUE(child >= first && child < first + 4);
      EXPECT_LE(DistanceOutside(tree.Shape(child), x), 1e-13); // round-off
    }
  }
}

TEST(ElementTree, ChildContainingTakesPointsBeyondTheBorder)
{
  ElementTree tree = TreeOfOne({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
  const NodeId first = tree.Split(0);
  EXPECT_EQ(tree.ChildContaining(0, { -1, -1, 0 }), first);
  EXPECT_EQ(tree.ChildContaining(0, { 2, 0.2, 0.1 }), first + 1);
  EXPECT_EQ(tree.ChildContaining(0, { 0.7, 3, 0 }), first + 2);
  EXPECT_EQ(tree.ChildContaining(0, { -0.1, 0.7, -0.1 }), first + 3);
}

TEST(ElementTree, LeafContainingDescendsToTheLeaf)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    ElementTree tree = TreeOfOne(RandomConvex(random, seed % 2 == 0 ? 3 : 4));
    const Polygon shape = tree.Shape(0);
    EXPECT_EQ(tree.LeafContaining(0, shape[0]), 0u);
    test::SplitAtRandom(tree, 50, random);
    for (int k = 0; k < 100; ++k)
    {
      const Vec3 x = PointAt(shape, random.Next2());
      const NodeId leaf = tree.LeafContaining(0, x);
      EXPECT_TRUE(tree[leaf].IsLeaf());
      EXPECT_LE(DistanceOutside(tree.Shape(leaf), x), 1e-13); // round-off
    }
  }
}

TEST(ElementTree, DoesNotDependOnTheOrderOfTheScene)
{
  const Scene scene = Scattered(9, 300);
  const ElementTree tree = TreeOf(scene);
  RandomStream random(1);
  const ElementTree shuffled = TreeOf(test::Shuffled(scene, random));
  ASSERT_EQ(tree.Size(), shuffled.Size());
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    ASSERT_EQ(tree[id].patch, shuffled[id].patch);
    ASSERT_EQ(tree[id].firstChild, shuffled[id].firstChild);
    ASSERT_EQ(tree[id].centre, shuffled[id].centre);
    ASSERT_EQ(tree[id].radius, shuffled[id].radius);
    ASSERT_EQ(tree[id].area, shuffled[id].area);
  }
}

} // namespace
} // namespace vantage
