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

struct Goal
{
  double error;    ///< relative, of the whole
  Accuracy pieces; ///< of the throughput of cells that see all of b
  int cells;       ///< made at most: what has been reached by then is returned
};

constexpr Goal GoalOf(Accuracy accuracy)
{
  return accuracy == Accuracy::Default ? Goal{ 5e-5, Accuracy::Default, 1 << 14 }
                                       : Goal{ 5e-7, Accuracy::Reference, 1 << 18 };
}

// Cells that an occluder shades in part are split this often before their error estimate counts:
// two coarse rules may miss the same small shadow.
constexpr int LeastLevel = 2;
constexpr int PointsPerSide = 3;

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
  double error = 0.0; ///< estimate
  int level = 0;
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
  }

  double Integrate();

private:
  std::vector<Polygon> FirstCells() const;
  Cell MakeCell(const Polygon& shape, const std::vector<int>& candidates) const;
  double Cubature(const Polygon& shape, const std::vector<int>& occluders) const;
  void Add(Cell cell);
  void SplitWorst();

  const FacingPair& Pair;
  std::vector<Polygon> Occluders;
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
  return cell;
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
  std::array<Cell, 4> children;
  const std::array<Polygon, 4> shapes = InFour(parent.shape);
  double change = -parent.value;
  for (int i = 0; i < 4; ++i)
  {
    children[i] = this->MakeCell(shapes[i], parent.occluders);
    children[i].level = parent.level + 1;
    change += children[i].value;
  }
  for (Cell& child : children)
  {
    // Where the integrand is smooth the change is far more than the error that is left.
    child.error =
      child.level < LeastLevel ? child.value + std::abs(change) : 0.25 * std::abs(change);
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
