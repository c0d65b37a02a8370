#include "core/mesh/ContactCuts.h"

#include "core/math/Box.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace vantage
{

namespace
{

/// Part of a line across a facet that must be covered for it to be cut there.
constexpr double LeastCovered = 0.75;
/// What is nearer than this, in diagonals of the scene, touches: the weld distance of BuildFacets.
constexpr double Touching = 1e-9;
/// A facet is cut along no more lines than these.
constexpr int MostCuts = 6;

/// Which facets are near which: a grid of cells of about their size, hashed.
class Neighbourhood
{
public:
  Neighbourhood(const std::vector<Facet>& facets, double tolerance)
    : Tolerance(tolerance)
  {
    double sum = 0.0;
    this->Boxes.reserve(facets.size());
    for (const Facet& facet : facets)
    {
      this->Boxes.emplace_back(facet.shape);
      sum += glm::length(this->Boxes.back().high - this->Boxes.back().low);
    }
    this->CellSize = std::max(2.0 * sum / static_cast<double>(facets.size()), 8.0 * tolerance);
    this->FillBuckets();
  }

  /// In ascending order, without itself.
  std::vector<std::uint32_t> Of(std::uint32_t facet) const
  {
    std::vector<std::uint32_t> found;
    const Box& box = this->Boxes[facet];
    this->ForEachCell(box,
      [&](const Cell& cell)
      {
        const std::uint32_t bucket = this->BucketOf(cell);
        for (std::uint32_t i = this->Starts[bucket]; i < this->Starts[bucket + 1]; ++i)
        {
          const std::uint32_t other = this->Entries[i];
          if (other != facet && this->Boxes[other].Touches(box, this->Tolerance) &&
              this->CellAt(glm::max(box.low, this->Boxes[other].low)) == cell)
          {
            found.push_back(other);
          }
        }
      });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

private:
  using Cell = glm::i64vec3;

  Cell CellAt(const Vec3& point) const
  {
    return Cell(glm::floor((point - this->Tolerance) / this->CellSize));
  }

  std::uint32_t BucketOf(const Cell& cell) const
  {
    const std::uint64_t hash = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15ull ^
                               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4full ^
                               static_cast<std::uint64_t>(cell.z) * 0x165667b19e3779f9ull;
    return static_cast<std::uint32_t>((hash >> 32) % (this->Starts.size() - 1));
  }

  template <typename Visit>
  void ForEachCell(const Box& box, const Visit& visit) const
  {
    const Cell low = this->CellAt(box.low);
    const Cell high(glm::floor((box.high + this->Tolerance) / this->CellSize));
    for (std::int64_t x = low.x; x <= high.x; ++x)
    {
      for (std::int64_t y = low.y; y <= high.y; ++y)
      {
        for (std::int64_t z = low.z; z <= high.z; ++z)
        {
          visit(Cell(x, y, z));
        }
      }
    }
  }

  /// A counting sort. Cells may share a bucket.
  void FillBuckets()
  {
    this->Starts.assign(2 * this->Boxes.size() + 2, 0);
    const auto forEachEntry = [this](const auto& visit)
    {
      for (std::uint32_t f = 0; f < this->Boxes.size(); ++f)
      {
        this->ForEachCell(
          this->Boxes[f], [&](const Cell& cell) { visit(f, this->BucketOf(cell)); });
      }
    };
    forEachEntry([this](std::uint32_t, std::uint32_t bucket) { ++this->Starts[bucket]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& start : this->Starts)
    {
      sum += start;
      start = sum;
    }
    this->Entries.resize(sum);
    forEachEntry([this](std::uint32_t facet, std::uint32_t bucket)
      { this->Entries[--this->Starts[bucket]] = facet; });
  }

  double Tolerance;
  double CellSize = 1.0;
  std::vector<Box> Boxes;
  std::vector<std::uint32_t> Starts; ///< of each bucket in the entries, and the end
  std::vector<std::uint32_t> Entries;
};

struct Segment
{
  Vec3 from, to;
};

/// Where a polygon meets a plane that it does not lie in, if along more than a point.
std::optional<Segment> Meeting(const Polygon& p, const Plane& plane, double tolerance)
{
  Segment meeting{};
  int points = 0;
  const auto add = [&](const Vec3& point) { (points++ == 0 ? meeting.from : meeting.to) = point; };
  for (int i = 0; i < p.Size(); ++i)
  {
    const Vec3& a = p[i];
    const Vec3& b = p[(i + 1) % p.Size()];
    const double da = plane.Distance(a);
    const double db = plane.Distance(b);
    if (std::abs(da) <= tolerance)
    {
      add(a);
    }
    else if (std::abs(db) > tolerance && (da > 0.0) != (db > 0.0))
    {
      add(a + da / (da - db) * (b - a));
    }
  }
  // All corners of a polygon in the plane; two points of one that stands on it or passes through.
  if (points != 2 || glm::length(meeting.to - meeting.from) <= tolerance)
  {
    return std::nullopt;
  }
  return meeting;
}

/// A line in the plane of a facet: points with dot(across.normal, x) = across.offset.
struct Line
{
  Plane across;
  Vec3 along;

  Line(const Segment& segment, const Vec3& normal)
    : along(glm::normalize(segment.to - segment.from))
  {
    const Vec3 sideways = glm::normalize(glm::cross(normal, this->along));
    this->across = { sideways, glm::dot(sideways, 0.5 * (segment.from + segment.to)) };
  }
  bool Holds(const Segment& segment, double tolerance) const
  {
    return std::abs(this->across.Distance(segment.from)) <= tolerance &&
           std::abs(this->across.Distance(segment.to)) <= tolerance;
  }
};

using Interval = std::pair<double, double>;

Interval Along(const Line& line, const Segment& segment)
{
  const double a = glm::dot(line.along, segment.from);
  const double b = glm::dot(line.along, segment.to);
  return { std::min(a, b), std::max(a, b) };
}

/// The part of the line within a polygon that it cuts in two; nothing when it passes beside it or
/// along its border.
std::optional<Interval> Across(const Polygon& p, const Line& line, double tolerance)
{
  double lowest = 0.0;
  double highest = 0.0;
  for (const Vec3& v : p)
  {
    lowest = std::min(lowest, line.across.Distance(v));
    highest = std::max(highest, line.across.Distance(v));
  }
  if (lowest >= -4.0 * tolerance || highest <= 4.0 * tolerance)
  {
    return std::nullopt;
  }
  const std::optional<Segment> chord = Meeting(p, line.across, tolerance);
  return chord ? std::optional(Along(line, *chord)) : std::nullopt;
}

/// Length of the chord that is covered by contacts on the line.
double Covered(
  const Line& line, const Interval& chord, const std::vector<Segment>& contacts, double tolerance)
{
  std::vector<Interval> parts;
  for (const Segment& contact : contacts)
  {
    if (line.Holds(contact, 2.0 * tolerance))
    {
      const Interval whole = Along(line, contact);
      parts.emplace_back(std::max(whole.first, chord.first), std::min(whole.second, chord.second));
    }
  }
  std::sort(parts.begin(), parts.end());
  double covered = 0.0;
  double end = chord.first;
  for (const Interval& part : parts)
  {
    covered += std::max(0.0, part.second - std::max(part.first, end));
    end = std::max(end, part.second);
  }
  return covered;
}

/// The line that is covered best, if any is covered well enough.
std::optional<Line> BestCut(
  const Polygon& piece, const std::vector<Segment>& contacts, const Vec3& normal, double tolerance)
{
  std::optional<Line> best;
  double mostCovered = LeastCovered;
  for (const Segment& contact : contacts)
  {
    const Line line(contact, normal);
    const std::optional<Interval> chord = Across(piece, line, tolerance);
    if (!chord)
    {
      continue;
    }
    const double covered =
      Covered(line, *chord, contacts, tolerance) / (chord->second - chord->first);
    if (covered > mostCovered * (1.0 + 1e-9))
    {
      mostCovered = covered;
      best = line;
    }
  }
  return best;
}

/// The line that any piece is to be cut along next.
std::optional<Line> NextCut(const std::vector<Polygon>& pieces,
  const std::vector<Segment>& contacts, const Vec3& normal, double tolerance)
{
  for (const Polygon& piece : pieces)
  {
    if (const std::optional<Line> cut = BestCut(piece, contacts, normal, tolerance))
    {
      return cut;
    }
  }
  return std::nullopt;
}

/// A line cuts all pieces that it crosses, so that no piece has a corner within an edge of another.
std::vector<Polygon> Pieces(
  const Polygon& whole, const std::vector<Segment>& contacts, double tolerance)
{
  const Vec3 normal = UnitNormal(whole);
  std::vector<Polygon> pieces{ whole };
  for (int cuts = 0; cuts < MostCuts; ++cuts)
  {
    const std::optional<Line> cut = NextCut(pieces, contacts, normal, tolerance);
    if (!cut)
    {
      break;
    }
    std::vector<Polygon> halves;
    for (const Polygon& piece : pieces)
    {
      if (Across(piece, *cut, tolerance))
      {
        halves.push_back(ClipToFront(piece, cut->across, tolerance));
        const Plane other{ -cut->across.normal, -cut->across.offset };
        halves.push_back(ClipToFront(piece, other, tolerance));
      }
      else
      {
        halves.push_back(piece);
      }
    }
    pieces = std::move(halves);
  }
  std::vector<Polygon> parts;
  for (const Polygon& piece : pieces)
  {
    const std::vector<Polygon> few = InQuadrilaterals(piece);
    parts.insert(parts.end(), few.begin(), few.end());
  }
  return parts;
}

} // namespace

FacetSet CutAtContacts(FacetSet set)
{
  const double tolerance = Touching * glm::length(set.high - set.low);
  const std::vector<Facet> facets = std::move(set.facets);
  const Neighbourhood near(facets, tolerance);
  set.facets = {};
  set.facets.reserve(facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f)
  {
    const Plane plane = SupportingPlane(facets[f].shape);
    std::vector<Segment> contacts;
    for (const std::uint32_t other : near.Of(f))
    {
      if (const auto contact = Meeting(facets[other].shape, plane, tolerance))
      {
        contacts.push_back(*contact);
      }
    }
    for (const Polygon& shape : Pieces(facets[f].shape, contacts, tolerance))
    {
      set.facets.push_back(facets[f]);
      set.facets.back().shape = TriangleOrQuadrilateral(shape);
    }
  }
  set.facets.shrink_to_fit();
  set.meanArea *= static_cast<double>(facets.size()) / static_cast<double>(set.facets.size());
  return set;
}

} // namespace vantage
