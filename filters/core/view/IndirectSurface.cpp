#include "core/view/IndirectSurface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage
{

namespace
{

/// Reach of a fit and of a model's weight, in sizes of the cell. A model reaches over its own cell
/// from wherever its point is, so that every spot has one.
constexpr double FitReach = 2.2;
constexpr double BlendReach = 1.5;
/// Slopes are only as large as the points ask for: part of the weight that speaks for none.
constexpr double FlatBelief = 0.01;
/// What is nearer to a wall than this part of its length is on it.
constexpr double Contact = 1e-6;
/// The way around a wall that ends nearer than this part of the reach counts, the nearer the more.
constexpr double SoftCorner = 0.15;
/// What is taken from the squared surprise for the noise: a little more than the noise itself, as
/// both are known roughly and what is left counts only where it is positive.
constexpr double NoiseMargin = 1.25;
/// Sum of weights that a plane through the points uses up; below the second, the points tell little
/// beyond their own noise.
constexpr double WeightOfPlane = 1.5;
constexpr double LeastWeightToJudge = 1.75;
/// Cells with fewer spots are not cut.
constexpr std::uint32_t LeastSpots = 2;

double Falloff(double squaredDistance, double squaredReach)
{
  const double t = 1.0 - squaredDistance / squaredReach;
  return t > 0.0 ? t * t : 0.0;
}

/// Normal equations of a plane through weighted values.
class PlaneFit
{
public:
  void Add(const Vec2& d, double weight, const Color& value)
  {
    this->Sum += weight;
    this->First += weight * d;
    this->XX += weight * d.x * d.x;
    this->XY += weight * d.x * d.y;
    this->YY += weight * d.y * d.y;
    this->Value += weight * value;
    this->ValueX += weight * d.x * value;
    this->ValueY += weight * d.y * value;
  }

  double Weight() const { return this->Sum; }

  /// Value and slopes at d = 0; `reach` is the size that slopes are judged by.
  std::array<Color, 3> Solve(double reach) const
  {
    const Vec2 mean = this->First / this->Sum;
    const Color value = this->Value / this->Sum;
    const double belief = FlatBelief * reach * reach;
    const double xx = this->XX / this->Sum - mean.x * mean.x + belief;
    const double yy = this->YY / this->Sum - mean.y * mean.y + belief;
    const double xy = this->XY / this->Sum - mean.x * mean.y;
    const Color vx = this->ValueX / this->Sum - mean.x * value;
    const Color vy = this->ValueY / this->Sum - mean.y * value;
    const double determinant = xx * yy - xy * xy;
    if (!(determinant > 0.0))
    {
      return { value, Color(0.0), Color(0.0) }; // all in one place
    }
    const Color alongX = (yy * vx - xy * vy) / determinant;
    const Color alongY = (xx * vy - xy * vx) / determinant;
    return { value - mean.x * alongX - mean.y * alongY, alongX, alongY };
  }

private:
  double Sum = 0.0, XX = 0.0, XY = 0.0, YY = 0.0;
  Vec2 First{ 0.0 };
  Color Value{ 0.0 }, ValueX{ 0.0 }, ValueY{ 0.0 };
};

double Cross(const Vec2& a, const Vec2& b)
{
  return a.x * b.y - a.y * b.x;
}

} // namespace

IndirectSurface::IndirectSurface(
  std::vector<SurfaceSpot> spots, std::vector<Foot> feet, std::size_t mostSpots)
  : Spots(std::move(spots))
  , Feet(std::move(feet))
{
  this->CloseFeet();
  this->DropIdleFeet();
  Cell all;
  all.last = static_cast<std::uint32_t>(this->Spots.size());
  Vec2 low = this->Spots[0].place;
  Vec2 high = low;
  for (const SurfaceSpot& spot : this->Spots)
  {
    low = glm::min(low, spot.place);
    high = glm::max(high, spot.place);
    all.weight += spot.weight;
  }
  all.size = std::max(high.x - low.x, high.y - low.y) * (1.0 + 1e-9);
  all.low = 0.5 * (low + high) - 0.5 * all.size;
  std::vector<Cell> waiting{ all };
  while (!waiting.empty())
  {
    Cell cell = waiting.back();
    waiting.pop_back();
    if (cell.last - cell.first > mostSpots && cell.size > 0.0)
    {
      const std::vector<Cell> quarters = this->Quarter(cell);
      waiting.insert(waiting.end(), quarters.begin(), quarters.end());
    }
    else
    {
      this->ChoosePoint(cell);
      this->Leaves.push_back(cell);
    }
  }
}

/// The spot nearest to the centre of gravity of all.
void IndirectSurface::ChoosePoint(Cell& cell) const
{
  Vec2 mean(0.0);
  for (std::uint32_t i = cell.first; i < cell.last; ++i)
  {
    mean += this->Spots[i].place;
  }
  mean /= static_cast<double>(cell.last - cell.first);
  double nearest = -1.0;
  for (std::uint32_t i = cell.first; i < cell.last; ++i)
  {
    const Vec2 d = this->Spots[i].place - mean;
    const double square = glm::dot(d, d);
    if (nearest < 0.0 || square < nearest)
    {
      nearest = square;
      cell.point = i;
    }
  }
}

/// The quarters that have spots. Their points are not chosen, but for the one with the cell's own.
std::vector<IndirectSurface::Cell> IndirectSurface::Quarter(const Cell& cell)
{
  const double half = 0.5 * cell.size;
  const Vec2 centre = cell.low + half;
  const auto begin = this->Spots.begin();
  const auto cut = [&](std::uint32_t first, std::uint32_t last, int axis)
  {
    return static_cast<std::uint32_t>(
      std::partition(begin + first, begin + last,
        [&](const SurfaceSpot& spot) { return spot.place[axis] < centre[axis]; }) -
      begin);
  };
  const std::uint32_t name = this->Spots[cell.point].index;
  const std::uint32_t middle = cut(cell.first, cell.last, 1);
  const std::uint32_t lower = cut(cell.first, middle, 0);
  const std::uint32_t upper = cut(middle, cell.last, 0);
  const std::array<std::uint32_t, 5> bounds{ cell.first, lower, middle, upper, cell.last };
  std::vector<Cell> quarters;
  for (int q = 0; q < 4; ++q)
  {
    if (bounds[q] == bounds[q + 1])
    {
      continue;
    }
    Cell quarter;
    quarter.low = cell.low + half * Vec2(q % 2, q / 2);
    quarter.size = half;
    quarter.first = bounds[q];
    quarter.last = bounds[q + 1];
    quarter.effort = cell.effort;
    for (std::uint32_t i = quarter.first; i < quarter.last; ++i)
    {
      quarter.weight += this->Spots[i].weight;
      if (cell.samples > 0 && this->Spots[i].index == name)
      {
        quarter.point = i;
        quarter.samples = cell.samples;
        quarter.value = cell.value;
        quarter.noise = cell.noise;
      }
    }
    quarters.push_back(quarter);
  }
  return quarters;
}

/// There is no way around the end of a wall that abuts on another one, or on a place where two
/// others meet. At the corner of a crate it meets one other only.
void IndirectSurface::CloseFeet()
{
  const auto isFree = [this](const Foot& foot, const Vec2& end)
  {
    int meetings = 0;
    for (const Foot& other : this->Feet)
    {
      const Vec2 wall = other.to - other.from;
      const double near = Contact * (glm::length(wall) + glm::distance(foot.from, foot.to));
      const double t = glm::dot(end - other.from, wall) / glm::dot(wall, wall);
      if (&other == &foot || glm::distance(end, other.from + std::clamp(t, 0.0, 1.0) * wall) > near)
      {
        continue;
      }
      const bool atItsEnd =
        glm::distance(end, other.from) <= near || glm::distance(end, other.to) <= near;
      meetings += atItsEnd ? 1 : 2;
    }
    return meetings < 2;
  };
  for (Foot& foot : this->Feet)
  {
    foot.fromIsFree = isFree(foot, foot.from);
    foot.toIsFree = isFree(foot, foot.to);
  }
}

/// A wall along the border, with all spots on one side, parts nothing.
void IndirectSurface::DropIdleFeet()
{
  const auto isIdle = [this](const Foot& foot)
  {
    const Vec2 wall = foot.to - foot.from;
    const double margin = Contact * glm::dot(wall, wall);
    const auto isLeft = [&](const SurfaceSpot& spot)
    { return Cross(wall, spot.place - foot.from) >= -margin; };
    const auto isRight = [&](const SurfaceSpot& spot)
    { return Cross(wall, spot.place - foot.from) <= margin; };
    return std::all_of(this->Spots.begin(), this->Spots.end(), isLeft) ||
           std::all_of(this->Spots.begin(), this->Spots.end(), isRight);
  };
  this->Feet.erase(std::remove_if(this->Feet.begin(), this->Feet.end(), isIdle), this->Feet.end());
}

void IndirectSurface::FindFeet(Model& model, const Vec2& place)
{
  model.firstFoot = static_cast<std::uint32_t>(this->FeetOfModels.size());
  for (const Foot& foot : this->Feet)
  {
    const Vec2 wall = foot.to - foot.from;
    const double t = glm::dot(place - foot.from, wall) / glm::dot(wall, wall);
    const Vec2 d = foot.from + std::clamp(t, 0.0, 1.0) * wall - place;
    if (glm::dot(d, d) < model.reach * model.reach)
    {
      this->FeetOfModels.push_back(foot);
    }
  }
  model.lastFoot = static_cast<std::uint32_t>(this->FeetOfModels.size());
}

/// How much of the way from the point of a model is open: 1, or less where a wall stands across it
/// by more than a little; close to the end of a wall the way around it is as good.
double IndirectSurface::Openness(const Vec2& a, const Vec2& b, const Model& model) const
{
  double open = 1.0;
  const Vec2 way = b - a;
  for (std::uint32_t f = model.firstFoot; f < model.lastFoot; ++f)
  {
    const Foot& foot = this->FeetOfModels[f];
    const Vec2 wall = foot.to - foot.from;
    const double turn = Cross(way, wall);
    if (turn == 0.0)
    {
      continue;
    }
    const double alongWay = Cross(foot.from - a, wall) / turn;
    const double alongWall = Cross(foot.from - a, way) / turn;
    const double low = foot.fromIsFree ? 0.0 : -Contact;
    const double high = foot.toIsFree ? 1.0 : 1.0 + Contact;
    if (alongWay > 0.0 && alongWay < 1.0 && alongWall > low && alongWall < high)
    {
      const double depth = std::min(foot.fromIsFree ? alongWall : 1.0 + Contact,
                             foot.toIsFree ? 1.0 - alongWall : 1.0 + Contact) *
                           glm::length(wall);
      const bool hasEnd = foot.fromIsFree || foot.toIsFree;
      open *= hasEnd ? std::max(0.0, 1.0 - depth / (SoftCorner * model.reach)) : 0.0;
    }
  }
  return open;
}

void IndirectSurface::FitAt(std::size_t i)
{
  Cell& cell = this->Leaves[i];
  const Vec2 place = this->PlaceOf(cell);
  const double reach = FitReach * cell.size;
  const double square = reach * reach;
  Model& model = this->Models[i];
  struct Neighbour
  {
    const Cell* cell;
    Vec2 d;
    double weight;
  };
  std::vector<Neighbour> all{ { &cell, Vec2(0.0), 1.0 } };
  for (std::size_t j = 0; j < this->Leaves.size(); ++j)
  {
    const Vec2 d = this->PlaceOf(this->Leaves[j]) - place;
    const double weight = j != i ? Falloff(glm::dot(d, d), square) : 0.0;
    if (weight > 0.0)
    {
      all.push_back({ &this->Leaves[j], d, weight * this->Openness(place, place + d, model) });
    }
  }
  model.reach = BlendReach * cell.size;
  PlaneFit fitter;
  double noise = 0.0;
  for (const Neighbour& n : all)
  {
    fitter.Add(n.d, n.weight, n.cell->value);
    noise += n.weight * n.cell->noise * n.cell->noise;
  }
  const std::array<Color, 3> fit = fitter.Solve(reach);
  model.value = fit[0];
  model.alongX = fit[1];
  model.alongY = fit[2];
  double roughness = 0.0;
  for (const Neighbour& n : all)
  {
    const double miss = Mean(n.cell->value - fit[0] - n.d.x * fit[1] - n.d.y * fit[2]);
    roughness += n.weight * miss * miss;
  }
  cell.noiseAround = std::sqrt(noise / fitter.Weight());
  cell.surprise = fitter.Weight() >= LeastWeightToJudge
                    ? std::sqrt(roughness / (fitter.Weight() - WeightOfPlane))
                    : cell.noiseAround;
}

void IndirectSurface::Fit()
{
  if (this->IsFitted)
  {
    return;
  }
  this->IsFitted = true;
  this->Models.assign(this->Leaves.size(), {});
  this->FeetOfModels.clear();
  for (std::size_t i = 0; i < this->Leaves.size(); ++i)
  {
    this->Models[i].reach = FitReach * this->Leaves[i].size;
    this->FindFeet(this->Models[i], this->PlaceOf(this->Leaves[i]));
  }
  tbb::parallel_for(std::size_t(0), this->Leaves.size(), [this](std::size_t i) { this->FitAt(i); });
}

double IndirectSurface::ModelError(const Cell& cell)
{
  const double model =
    cell.surprise * cell.surprise - NoiseMargin * cell.noiseAround * cell.noiseAround;
  return cell.last - cell.first >= LeastSpots ? cell.weight * std::sqrt(std::max(model, 0.0)) : 0.0;
}

std::size_t IndirectSurface::Refine(double limit)
{
  std::vector<Cell> refined;
  std::size_t cuts = 0;
  for (const Cell& cell : this->Leaves)
  {
    if (ModelError(cell) < limit)
    {
      refined.push_back(cell);
      continue;
    }
    ++cuts;
    for (Cell quarter : this->Quarter(cell))
    {
      if (quarter.samples == 0)
      {
        this->ChoosePoint(quarter);
      }
      refined.push_back(quarter);
    }
  }
  this->Leaves = std::move(refined);
  this->IsFitted = this->IsFitted && cuts == 0;
  return cuts;
}

std::size_t IndirectSurface::Doubt(double relativeNoise, double noise, std::uint32_t mostEffort)
{
  std::size_t doubtful = 0;
  for (Cell& cell : this->Leaves)
  {
    if (cell.effort < mostEffort && (cell.noiseAround > relativeNoise * Mean(cell.value) ||
                                      cell.weight * cell.noiseAround >= noise))
    {
      cell.effort *= 4;
      cell.samples = 0;
      ++doubtful;
    }
  }
  this->IsFitted = this->IsFitted && doubtful == 0;
  return doubtful;
}

std::vector<IndirectSurface::Reaching> IndirectSurface::ReachingInto(const Cell& cell) const
{
  std::vector<Reaching> near;
  for (std::uint32_t j = 0; j < this->Leaves.size(); ++j)
  {
    const Model& model = this->Models[j];
    const Vec2 place = this->PlaceOf(this->Leaves[j]);
    const Vec2 d = place - glm::clamp(place, cell.low, cell.low + cell.size);
    const double square = model.reach * model.reach;
    if (glm::dot(d, d) < square)
    {
      near.push_back({ place, 1.0 / square, &model });
    }
  }
  return near;
}

void IndirectSurface::Evaluate(Color* values) const
{
  tbb::parallel_for(std::size_t(0), this->Leaves.size(),
    [this, values](std::size_t i) { this->EvaluateIn(this->Leaves[i], values); });
}

void IndirectSurface::EvaluateIn(const Cell& cell, Color* values) const
{
  const std::vector<Reaching> near = this->ReachingInto(cell);
  for (std::uint32_t i = cell.first; i < cell.last; ++i)
  {
    const Vec2 place = this->Spots[i].place;
    Color sum(0.0);
    double total = 0.0;
    for (const Reaching& one : near)
    {
      const Vec2 d = place - one.place;
      const double t = 1.0 - glm::dot(d, d) * one.inverseSquare;
      if (t > 0.0)
      {
        const Model& model = *one.model;
        const double weight = t * t * this->Openness(one.place, place, model);
        sum += weight * (model.value + d.x * model.alongX + d.y * model.alongY);
        total += weight;
      }
    }
    values[this->Spots[i].index] = total > 0.0 ? glm::max(sum / total, Color(0.0)) : cell.value;
  }
}

} // namespace vantage
