#include "core/formfactor/Blocking.h"
#include "core/formfactor/FacingPair.h"
#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shadows.h"
#include "core/formfactor/Subdivision.h"
#include "core/formfactor/SurfaceQuadrature.h"

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

/// Two coarse rules may agree by chance or miss the same small feature. A coarse result survives a
/// few of these; among the thousands of cells of a fine one they are certain to occur.
struct Goal
{
  double error;    ///< relative, of the whole
  Accuracy pieces; ///< of the throughput of cells that see all of b
  int cells;       ///< made at most, about: what has been reached by then is returned
  int leastLevel;  ///< cells are split in four this often before their error estimate counts
  double gain;     ///< then the error of a quarter is at least this part of that of the cell
};

constexpr Goal GoalOf(Accuracy accuracy)
{
  // Along a kink the error of a quarter is an eighth of that of the cell.
  return accuracy == Accuracy::Default ? Goal{ 5e-5, Accuracy::Default, 1 << 14, 2, 0.0 }
                                       : Goal{ 5e-7, Accuracy::Reference, 1 << 18, 4, 1.0 / 64.0 };
}

constexpr int PointsPerSide = 3;

// A penumbra that covers less of a cell than this, or a rim of as little around an umbra, may lie
// between the points in the cell and in its quarters. The light that it may hide, or let pass,
// counts as error, and the cell is cut along its sides.
constexpr double LeastCover = 0.25;

// The error of what is seen of a pair that is hidden but for a smaller part than this may be
// relative to this part: cracks of light would cost more than all other pairs together.
constexpr double NearlyHidden = 0.1;

// In units of the pair: what is nearer to a plane than this touches it. An occluder that lies in
// the plane of a polygon, such as the polygon itself, hides nothing; one that stands on it is cut
// there.
constexpr double Touching = 1e-10;

/// A part of polygon a, with three or four vertices.
struct Cell
{
  Polygon shape;
  std::vector<int> occluders; ///< those that shade it in part
  double value = 0.0;
  double error = 0.0;  ///< estimate
  double missed = 0.0; ///< about what may be hidden or seen in parts that cover little of the cell
  int toCutOut = -1;   ///< the region with the largest of these parts, if any
  int level = 0;       ///< how often it was split in four
};

bool SmallerError(const Cell& one, const Cell& other)
{
  return one.error < other.error;
}

/// Adaptive cubature over polygon a of what its points see of b. The integrand has kinks along the
/// lines where shadows pass the vertices and edges of b, so cells are split where halving them
/// still changes their sum, the worst first.
class VisibleIntegral
{
public:
  /// `unoccluded` is the throughput without any occluder.
  VisibleIntegral(
    const FacingPair& pair, std::vector<Polygon> occluders, const Goal& goal, double unoccluded)
    : Pair(pair)
    , Occluders(std::move(occluders))
    , Target(goal)
    , Unoccluded(unoccluded)
  {
    for (const Polygon& occluder : this->Occluders)
    {
      this->Regions.push_back(PenumbraSides(pair.b, occluder, Touching));
      this->Regions.push_back(UmbraSides(pair.b, occluder, Touching));
    }
  }

  double Integrate();

private:
  std::vector<Polygon> FirstCells() const;
  Cell MakeCell(const Polygon& shape, const std::vector<int>& candidates) const;
  double Cubature(const Polygon& shape, const std::vector<int>& occluders) const;
  Polygon InRegion(const Polygon& shape, int region, std::vector<Polygon>& rest) const;
  void FindMissed(Cell& cell) const;
  std::vector<Polygon> Parts(const Cell& cell) const;
  void Add(Cell cell);
  void SplitWorst();

  const FacingPair& Pair;
  std::vector<Polygon> Occluders;
  std::vector<std::vector<Plane>> Regions; ///< of occluder i: 2 i its penumbra, 2 i + 1 its umbra
  Goal Target;
  double Unoccluded;
  std::vector<Cell> Heap; ///< cells whose values are not certain, the largest error first
  double Certain = 0.0;   ///< sum of the others
  double Uncertain = 0.0;
  double Error = 0.0;
};

/// Polygon a, cut along the feet of the occluders that stand on it: what is seen jumps there.
std::vector<Polygon> VisibleIntegral::FirstCells() const
{
  std::vector<Polygon> cells{ this->Pair.a };
  const Plane ground{ this->Pair.normalA, glm::dot(this->Pair.normalA, this->Pair.a[0]) };
  for (const Polygon& occluder : this->Occluders)
  {
    double lowest = ground.Distance(occluder[0]);
    for (const Vec3& v : occluder)
    {
      lowest = std::min(lowest, ground.Distance(v));
    }
    if (lowest > Touching)
    {
      continue;
    }
    const Plane wall = SupportingPlane(occluder);
    std::vector<Polygon> cut;
    for (const Polygon& cell : cells)
    {
      for (const Plane& side : { wall, Plane{ -wall.normal, -wall.offset } })
      {
        const Polygon part = ClipToFront(cell, side, Touching);
        if (!part.Empty())
        {
          const std::vector<Polygon> parts = InQuadrilaterals(part);
          cut.insert(cut.end(), parts.begin(), parts.end());
        }
      }
    }
    cells = cut;
  }
  std::vector<Polygon> parts;
  for (const Polygon& cell : cells)
  {
    const std::vector<Polygon> few = InQuadrilaterals(cell);
    parts.insert(parts.end(), few.begin(), few.end());
  }
  return parts;
}

double VisibleIntegral::Cubature(const Polygon& shape, const std::vector<int>& occluders) const
{
  std::vector<Polygon> chosen;
  for (const int i : occluders)
  {
    chosen.push_back(this->Occluders[i]);
  }
  const SurfaceNodes nodes = NodesOn(shape, PointsPerSide);
  double sum = 0.0;
  for (int k = 0; k < nodes.count; ++k)
  {
    sum += nodes.weights[k] *
           PointToVisiblePolygon(nodes.Point(k), this->Pair.normalA, this->Pair.b, chosen);
  }
  return sum;
}

/// The part of the shape in a region that it reaches into. What is cut off is added to `rest`.
Polygon VisibleIntegral::InRegion(
  const Polygon& shape, int region, std::vector<Polygon>& rest) const
{
  Polygon inside = shape;
  for (const Plane& side : this->Regions[region])
  {
    const bool allInFront = std::all_of(inside.begin(), inside.end(),
      [&side](const Vec3& v) { return side.Distance(v) >= -Touching; });
    if (allInFront || inside.Size() == Polygon::Capacity)
    {
      continue; // without room for one more vertex, more than the region is taken
    }
    const Polygon front = ClipToFront(inside, side, Touching);
    const Polygon back = ClipToFront(inside, { -side.normal, -side.offset }, Touching);
    if (!front.Empty() && !back.Empty())
    {
      rest.push_back(back);
      inside = front;
    }
  }
  return inside;
}

void VisibleIntegral::FindMissed(Cell& cell) const
{
  const double area = Area(cell.shape);
  double missed = 0.0;
  double most = 0.0;
  std::vector<Polygon> rest;
  for (const int i : cell.occluders)
  {
    for (const int region : { 2 * i, 2 * i + 1 })
    {
      rest.clear();
      const double covered = Area(this->InRegion(cell.shape, region, rest));
      const double small = region == 2 * i || rest.empty() ? covered : area - covered;
      if (small < LeastCover * area)
      {
        missed += small;
        cell.toCutOut = small > most ? region : cell.toCutOut;
        most = std::max(most, small);
      }
    }
  }
  if (missed > 0.0)
  {
    cell.missed = missed * PointToPolygon(Centroid(cell.shape), this->Pair.normalA, this->Pair.b);
  }
}

Cell VisibleIntegral::MakeCell(const Polygon& shape, const std::vector<int>& candidates) const
{
  Cell cell;
  cell.shape = shape;
  for (const int i : candidates)
  {
    const Blocking blocking = BlockingBetween(shape, this->Pair.b, this->Occluders[i], Touching);
    if (blocking == Blocking::Full)
    {
      cell.occluders.clear();
      return cell;
    }
    if (blocking == Blocking::Partial)
    {
      cell.occluders.push_back(i);
    }
  }
  cell.value = cell.occluders.empty() ? Throughput(shape, this->Pair.b, this->Target.pieces)
                                      : this->Cubature(shape, cell.occluders);
  this->FindMissed(cell);
  return cell;
}

/// What to make of a cell that is not good enough.
std::vector<Polygon> VisibleIntegral::Parts(const Cell& cell) const
{
  if (cell.toCutOut < 0)
  {
    const std::array<Polygon, 4> quarters = InFour(cell.shape);
    return { quarters.begin(), quarters.end() };
  }
  std::vector<Polygon> pieces;
  const Polygon inside = this->InRegion(cell.shape, cell.toCutOut, pieces);
  pieces.push_back(inside);
  std::vector<Polygon> parts;
  for (const Polygon& piece : pieces)
  {
    const std::vector<Polygon> few = InQuadrilaterals(piece);
    parts.insert(parts.end(), few.begin(), few.end());
  }
  return parts;
}

void VisibleIntegral::Add(Cell cell)
{
  if (cell.occluders.empty())
  {
    this->Certain += cell.value;
    return;
  }
  this->Uncertain += cell.value;
  this->Error += cell.error;
  this->Heap.push_back(std::move(cell));
  std::push_heap(this->Heap.begin(), this->Heap.end(), SmallerError);
}

void VisibleIntegral::SplitWorst()
{
  std::pop_heap(this->Heap.begin(), this->Heap.end(), SmallerError);
  const Cell parent = std::move(this->Heap.back());
  this->Heap.pop_back();
  this->Uncertain -= parent.value;
  this->Error -= parent.error;
  const bool inFour = parent.toCutOut < 0;
  const bool hasEstimate = inFour && parent.level >= this->Target.leastLevel;
  const double least = hasEstimate ? this->Target.gain * parent.error : 0.0;
  std::vector<Cell> children;
  double change = -parent.value;
  int uncertain = 0;
  for (const Polygon& shape : this->Parts(parent))
  {
    children.push_back(this->MakeCell(shape, parent.occluders));
    change += children.back().value;
    uncertain += children.back().occluders.empty() ? 0 : 1;
  }
  // Where the integrand is smooth the change is far more than the error that is left.
  const double share = std::abs(change) / std::max(uncertain, 1);
  for (Cell& child : children)
  {
    child.level = parent.level + (inFour ? 1 : 0);
    child.error = child.level < this->Target.leastLevel ? child.value + std::abs(change)
                                                        : std::max(share, least);
    child.error += child.missed;
    this->Add(std::move(child));
  }
}

double VisibleIntegral::Integrate()
{
  std::vector<int> all(this->Occluders.size());
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    all[i] = static_cast<int>(i);
  }
  for (const Polygon& shape : this->FirstCells())
  {
    Cell cell = this->MakeCell(shape, all);
    cell.error = Pi * Area(shape);
    this->Add(std::move(cell));
  }
  const auto isEnough = [this]()
  {
    const double size = std::max(this->Certain + this->Uncertain, NearlyHidden * this->Unoccluded);
    return this->Heap.empty() || this->Error <= this->Target.error * size;
  };
  for (int made = 0; made < this->Target.cells && !isEnough(); made += 4)
  {
    this->SplitWorst();
  }
  return this->Certain + this->Uncertain;
}

/// Adds the part of an occluder that is in front of both polygons, unless it cannot matter.
void AddBetween(const FacingPair& pair, const Polygon& occluder, std::vector<Polygon>& between)
{
  // It is clipped three times before its shadow is cut out, here and in front of each point.
  constexpr int clips = 3;
  if (occluder.Size() + clips > MaxOccluderVertices)
  {
    for (const Polygon& half : InHalves(occluder))
    {
      AddBetween(pair, half, between);
    }
    return;
  }
  Polygon part = occluder;
  for (const Plane& plane : { Plane{ pair.normalA, glm::dot(pair.normalA, pair.a[0]) },
         Plane{ pair.normalB, glm::dot(pair.normalB, pair.b[0]) } })
  {
    part = ClipToFront(part, plane, Touching);
  }
  if (!part.Empty() && BlockingBetween(pair.a, pair.b, part, Touching) != Blocking::None)
  {
    between.push_back(part);
  }
}

} // namespace

double VisibleThroughput(
  const Polygon& a, const Polygon& b, const std::vector<Polygon>& occluders, Accuracy accuracy)
{
  const std::optional<FacingPair> pair = Face(a, b);
  if (!pair)
  {
    return 0.0;
  }
  std::vector<Polygon> between;
  for (const Polygon& occluder : occluders)
  {
    Polygon moved;
    for (const Vec3& v : occluder)
    {
      moved.Add((v - pair->origin) / pair->unit);
    }
    AddBetween(*pair, moved, between);
  }
  if (between.empty())
  {
    return Throughput(a, b, accuracy);
  }
  const double unoccluded = Throughput(pair->a, pair->b, accuracy);
  VisibleIntegral integral(*pair, std::move(between), GoalOf(accuracy), unoccluded);
  return integral.Integrate() * pair->unit * pair->unit;
}

} // namespace vantage
