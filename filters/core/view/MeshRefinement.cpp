#include "core/view/MeshRefinement.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <unordered_map>

namespace vantage
{

namespace
{

/// A view starts with elements that each fill no more than this part of it.
constexpr double LargestPart = 1.0 / 2000.0;
/// ... as far as the samples of the view can tell: so many to an element.
constexpr double LeastSamples = 4.0;
/// No element is split that fills less: a quarter of a pixel of 512 x 512 of them.
constexpr double SmallestPart = 1e-6;
constexpr std::uint8_t HighestLevel = 20;
constexpr int MostRounds = 12;
/// Mean error of interpolation over an element, over the mean of what it is at the points that a
/// split would add: across an edge of a shadow, where it is 0 at some of them.
constexpr double ErrorOfMiddles = 1.2;
/// Part of the error of an element that goes when it is split, where light jumps.
constexpr double GainOfSplit = 0.5;

/// A point of a patch. Exact comparison is right: elements compute a common midpoint from the same
/// two corners, and the sum of two numbers does not depend on their order.
struct Place
{
  PatchId patch;
  Vec3 point;

  bool operator==(const Place& other) const
  {
    return this->patch == other.patch && this->point == other.point;
  }
};

struct HashOfPlace
{
  std::size_t operator()(const Place& place) const
  {
    const std::hash<double> hash;
    return Hash(place.patch, hash(place.point.x), hash(place.point.y), hash(place.point.z));
  }
};

/// Direct irradiance at places, computed for many at once and kept.
class DirectPlaces
{
public:
  DirectPlaces(const SurfaceGather& gather, GatherCounts& counts)
    : Gather(&gather)
    , Counts(&counts)
  {
  }

  /// At() may be asked for it after the next Measure().
  void Want(const Place& place)
  {
    if (this->Known.try_emplace(place, 0.0).second)
    {
      this->Wanted.push_back({ place.patch, place.point });
    }
  }

  void Measure()
  {
    const std::vector<Color> irradiance = this->Gather->Direct(this->Wanted, 0.0, *this->Counts);
    for (std::size_t i = 0; i < this->Wanted.size(); ++i)
    {
      this->Known[{ this->Wanted[i].patch, this->Wanted[i].point }] = irradiance[i];
    }
    this->Wanted.clear();
  }

  const Color& At(const Place& place) const { return this->Known.at(place); }

private:
  const SurfaceGather* Gather;
  GatherCounts* Counts;
  std::unordered_map<Place, Color, HashOfPlace> Known;
  std::vector<GatherPoint> Wanted;
};

/// The points that a split gives to an element, each with the corners it lies in the middle of.
struct Middles
{
  struct Middle
  {
    Vec3 point;
    std::array<int, 4> corners;
    int cornerCount;
  };
  std::array<Middle, 5> points;
  int count = 0;

  /// As ElementTree::Split computes them.
  explicit Middles(const Node& node)
  {
    const int n = node.cornerCount;
    for (int i = 0; i < n; ++i)
    {
      const int next = (i + 1) % n;
      this->points[this->count++] = { Midpoint(node.corners[i], node.corners[next]), { i, next },
        2 };
    }
    if (n == 4)
    {
      const Vec3 centre = Midpoint(
        Midpoint(node.corners[0], node.corners[2]), Midpoint(node.corners[1], node.corners[3]));
      this->points[this->count++] = { centre, { 0, 1, 2, 3 }, 4 };
    }
  }
};

class MeshRefiner
{
public:
  MeshRefiner(const SurfaceGather& gather, const RadianceSolution& solution, ElementTree tree,
    const std::vector<ViewSample>& view, GatherCounts& counts)
    : Solution(solution)
    , Tree(std::move(tree))
    , Direct(gather, counts)
  {
    this->Weights.Set(this->Tree, view);
    std::vector<char> isSeen(this->Tree.Patches().size(), 0);
    for (const ViewSample& sample : view)
    {
      this->AllWeight += sample.weight;
      isSeen[sample.patch] = 1;
    }
    const double samples = static_cast<double>(view.size());
    this->Largest = this->AllWeight * std::max(LargestPart, LeastSamples / std::max(samples, 1.0));
    for (NodeId id = 0; id < this->Tree.Size(); ++id)
    {
      const Node& node = this->Tree[id];
      if (!node.IsCluster() && node.IsLeaf() && isSeen[node.patch])
      {
        this->Leaves.push_back(id);
      }
    }
  }

  ElementTree Run(double error)
  {
    this->SplitLargeOnes();
    for (int round = 0; round < MostRounds && this->SplitWhereLightIsUneven(error); ++round)
    {
    }
    return std::move(this->Tree);
  }

private:
  void SplitLargeOnes();
  bool SplitWhereLightIsUneven(double error);
  void MeasureLeaves();
  double ErrorOf(NodeId leaf) const;
  double ViewOfDirectLight() const;
  void SplitWorst(const std::vector<double>& errors, double goal);
  void Split(NodeId leaf);
  void Balance(NodeId parent);
  bool MaySplit(NodeId leaf) const;

  /// Of the view, sr.
  double PartOf(NodeId node) const
  {
    return this->Weights.Value(this->Tree, node) * this->Tree[node].area;
  }

  const RadianceSolution& Solution;
  ElementTree Tree;
  DirectPlaces Direct;
  ViewWeights Weights;
  double AllWeight = 0.0;     ///< of the view, sr
  double Largest = 0.0;       ///< part of it that an element may fill
  std::vector<NodeId> Leaves; ///< of seen patches
};

void MeshRefiner::SplitLargeOnes()
{
  // Leaves are appended while the loop runs.
  for (std::size_t i = 0; i < this->Leaves.size(); ++i)
  {
    if (this->Tree[this->Leaves[i]].level > 0)
    {
      this->Balance(this->Tree[this->Leaves[i]].parent);
    }
    if (this->PartOf(this->Leaves[i]) > this->Largest && this->MaySplit(this->Leaves[i]))
    {
      this->Split(this->Leaves[i]);
    }
  }
}

bool MeshRefiner::MaySplit(NodeId leaf) const
{
  const Node& node = this->Tree[leaf];
  const bool isLarge = this->PartOf(leaf) > SmallestPart * this->AllWeight;
  return isLarge && node.IsLeaf() && node.level != HighestLevel;
}

void MeshRefiner::Split(NodeId leaf)
{
  const NodeId first = this->Tree.Split(leaf);
  this->Weights.FollowSplit(this->Tree, leaf);
  for (NodeId child = first; child < first + 4; ++child)
  {
    this->Leaves.push_back(child);
  }
  this->Balance(leaf);
}

/// Splits the neighbours on the same patch of an element that was split, where these are more than
/// one level above its children.
void MeshRefiner::Balance(NodeId parent)
{
  const Node node = this->Tree[parent];
  const NodeId root = this->Tree.PatchOfNode(parent).node;
  for (int i = 0; i < node.cornerCount; ++i)
  {
    const Vec3 middle = Midpoint(node.corners[i], node.corners[(i + 1) % node.cornerCount]);
    const Vec3 beyond = middle + 1e-3 * (middle - node.centre);
    const auto neighbour = [&] { return this->Tree.LeafContaining(root, beyond); };
    while (this->Tree[neighbour()].level < node.level)
    {
      this->Split(neighbour());
    }
  }
}

/// Returns whether there was anything to do.
bool MeshRefiner::SplitWhereLightIsUneven(double error)
{
  this->MeasureLeaves();
  std::vector<double> errors;
  for (const NodeId leaf : this->Leaves)
  {
    errors.push_back(this->ErrorOf(leaf));
  }
  const double goal = error * this->ViewOfDirectLight();
  const bool isUneven = std::accumulate(errors.begin(), errors.end(), 0.0) > goal;
  if (isUneven)
  {
    this->SplitWorst(errors, goal);
  }
  return isUneven;
}

/// Light at the corners and the middles of all leaves.
void MeshRefiner::MeasureLeaves()
{
  const ElementTree& tree = this->Tree;
  this->Leaves.erase(std::remove_if(this->Leaves.begin(), this->Leaves.end(),
                       [&tree](NodeId id) { return !tree[id].IsLeaf(); }),
    this->Leaves.end());
  for (const NodeId leaf : this->Leaves)
  {
    const Node& node = tree[leaf];
    for (int i = 0; i < node.cornerCount; ++i)
    {
      this->Direct.Want({ node.patch, node.corners[i] });
    }
    const Middles middles(node);
    for (int k = 0; k < middles.count && this->MaySplit(leaf); ++k)
    {
      this->Direct.Want({ node.patch, middles.points[k].point });
    }
  }
  this->Direct.Measure();
}

/// What interpolation from the corners adds to the error of the picture, sr W m^-2 sr^-1.
double MeshRefiner::ErrorOf(NodeId leaf) const
{
  if (!this->MaySplit(leaf))
  {
    return 0.0;
  }
  const Node& node = this->Tree[leaf];
  const Middles middles(node);
  double sum = 0.0;
  for (int k = 0; k < middles.count; ++k)
  {
    const Middles::Middle& middle = middles.points[k];
    Color mean(0.0);
    for (int c = 0; c < middle.cornerCount; ++c)
    {
      mean += this->Direct.At({ node.patch, node.corners[middle.corners[c]] });
    }
    mean /= static_cast<double>(middle.cornerCount);
    sum += Mean(glm::abs(
      this->Solution.albedo[node.patch] * (this->Direct.At({ node.patch, middle.point }) - mean)));
  }
  return ErrorOfMiddles * this->PartOf(leaf) / Pi * sum / middles.count;
}

/// Light of the picture, without what is reflected more than once, in the same unit.
double MeshRefiner::ViewOfDirectLight() const
{
  double sum = 0.0;
  for (const NodeId leaf : this->Leaves)
  {
    const Node& node = this->Tree[leaf];
    Color irradiance(0.0);
    for (int i = 0; i < node.cornerCount; ++i)
    {
      irradiance += this->Direct.At({ node.patch, node.corners[i] });
    }
    const Color radiance = this->Solution.emission[node.patch] + this->Solution.albedo[node.patch] /
                                                                   Pi * irradiance /
                                                                   double(node.cornerCount);
    sum += this->PartOf(leaf) * Mean(radiance);
  }
  return sum;
}

/// The worst first, as many as will bring the sum down to the goal, but none that is no part of the
/// trouble: where shadows have sharp edges, one round is not enough.
void MeshRefiner::SplitWorst(const std::vector<double>& errors, double goal)
{
  std::vector<std::uint32_t> order;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < errors.size(); ++i)
  {
    sum += errors[i];
    if (errors[i] > 0.0)
    {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(),
    [&errors](std::uint32_t a, std::uint32_t b)
    { return errors[a] != errors[b] ? errors[a] > errors[b] : a < b; });
  for (const std::uint32_t i : order)
  {
    if (sum <= goal || errors[i] < goal / static_cast<double>(errors.size()))
    {
      break;
    }
    sum -= GainOfSplit * errors[i];
    // Balancing may have split it already.
    if (this->Tree[this->Leaves[i]].IsLeaf())
    {
      this->Split(this->Leaves[i]);
    }
  }
}

} // namespace

ElementTree RefineForView(const SurfaceGather& gather, const RadianceSolution& solution,
  ElementTree tree, const std::vector<ViewSample>& view, double error, GatherCounts& counts)
{
  return MeshRefiner(gather, solution, std::move(tree), view, counts).Run(error);
}

} // namespace vantage
