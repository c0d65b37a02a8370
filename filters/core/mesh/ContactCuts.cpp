#include "core/mesh/ContactCuts.h"

#include "core/mesh/Neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace vantage
{

namespace
{

/// Part of a line across a facet that must be covered for it to be cut there.
constexpr double LeastCovered = 0.75;
/// A facet is cut along no more lines than these.
constexpr int MostCuts = 6;

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

std::vector<Polygon> Halves(const std::vector<Polygon>& pieces, const Line& cut, double tolerance)
{
  std::vector<Polygon> halves;
  for (const Polygon& piece : pieces)
  {
    if (Across(piece, cut, tolerance))
    {
      halves.push_back(ClipToFront(piece, cut.across, tolerance));
      const Plane other{ -cut.across.normal, -cut.across.offset };
      halves.push_back(ClipToFront(piece, other, tolerance));
    }
    else
    {
      halves.push_back(piece);
    }
  }
  return halves;
}

/// A line cuts all pieces that it crosses, so that no piece has a corner within an edge of another.
/// Nothing where there is no line to cut along.
std::vector<Polygon> Pieces(
  const Polygon& whole, const std::vector<Segment>& contacts, double tolerance)
{
  const Vec3 normal = UnitNormal(whole);
  std::optional<Line> cut = BestCut(whole, contacts, normal, tolerance);
  if (!cut)
  {
    return {};
  }
  std::vector<Polygon> pieces{ whole };
  for (int cuts = 0; cut && cuts < MostCuts; ++cuts)
  {
    pieces = Halves(pieces, *cut, tolerance);
    cut = NextCut(pieces, contacts, normal, tolerance);
  }
  std::vector<Polygon> parts;
  for (const Polygon& piece : pieces)
  {
    const std::vector<Polygon> few = InQuadrilaterals(piece);
    parts.insert(parts.end(), few.begin(), few.end());
  }
  return parts;
}

/// Where the others near a facet meet it.
class Contacts
{
public:
  Contacts(const std::vector<Facet>& facets, double tolerance)
    : Facets(facets)
    , Tolerance(tolerance)
    , Near(NeighboursOf(facets, tolerance))
  {
  }

  /// In the order of the facets. Valid until the next call.
  const std::vector<Segment>& Of(std::uint32_t facet)
  {
    const Plane plane = SupportingPlane(this->Facets[facet].shape);
    this->Found.clear();
    for (const std::uint32_t other : this->Near.Of(facet))
    {
      if (const auto contact = Meeting(this->Facets[other].shape, plane, this->Tolerance))
      {
        this->Found.push_back(*contact);
      }
    }
    return this->Found;
  }

private:
  const std::vector<Facet>& Facets;
  double Tolerance;
  PackedLists<std::uint32_t> Near;
  std::vector<Segment> Found;
};

} // namespace

FacetSet CutAtContacts(FacetSet set)
{
  struct CutFacet
  {
    std::uint32_t facet;
    std::vector<Polygon> pieces;
  };
  const double tolerance = set.Tolerance();
  std::vector<CutFacet> cutFacets;
  std::size_t count = set.facets.size();
  Contacts contacts(set.facets, tolerance);
  for (std::uint32_t f = 0; f < set.facets.size(); ++f)
  {
    std::vector<Polygon> pieces = Pieces(set.facets[f].shape, contacts.Of(f), tolerance);
    if (!pieces.empty())
    {
      count += pieces.size() - 1;
      cutFacets.push_back({ f, std::move(pieces) });
    }
  }
  if (cutFacets.empty())
  {
    return set;
  }
  std::vector<Facet> facets;
  facets.reserve(count);
  std::uint32_t done = 0;
  for (const auto& [facet, pieces] : cutFacets)
  {
    facets.insert(facets.end(), set.facets.begin() + done, set.facets.begin() + facet);
    for (const Polygon& piece : pieces)
    {
      facets.push_back(set.facets[facet]);
      facets.back().shape = TriangleOrQuadrilateral(piece);
    }
    done = facet + 1;
  }
  facets.insert(facets.end(), set.facets.begin() + done, set.facets.end());
  set.meanArea *= static_cast<double>(set.facets.size()) / static_cast<double>(count);
  set.facets = std::move(facets);
  return set;
}

} // namespace vantage
