#include "core/view/LampSurface.h"

#include "core/formfactor/FormFactor.h"
#include "core/mesh/Bounds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace vantage
{

namespace
{

constexpr std::uint32_t Nothing = static_cast<std::uint32_t>(-1);
/// Relative to the size of the lamp: what is nearer to a plane than this is in it.
constexpr double SamePlane = 1e-9;
/// A cell of so many faces is not halved.
constexpr std::uint32_t SmallCell = 4;

struct IsBefore
{
  bool operator()(const Vec3& a, const Vec3& b) const
  {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

} // namespace

LampSurface::LampSurface(const std::vector<Polygon>& faces)
{
  if (faces.empty())
  {
    return;
  }
  std::vector<Vec3> middles;
  for (const Polygon& face : faces)
  {
    middles.push_back(Centroid(face));
  }
  std::vector<std::uint32_t> order(faces.size());
  std::iota(order.begin(), order.end(), 0u);
  this->AddCells(middles, 0, static_cast<std::uint32_t>(faces.size()), order);
  this->AddCorners(faces, order);
  for (const std::uint32_t k : order)
  {
    this->Planes.push_back(SupportingPlane(faces[k]));
    this->Middles.push_back(middles[k]);
  }
  this->FindEdges();
  this->FindBoxes();
  this->Only = LampKernel(faces.size() == 1 ? faces[0] : Polygon());
  const Plane& plane = this->Planes[0];
  const double size = glm::length(this->Cells[0].half);
  this->Flat =
    std::all_of(this->Places.begin(), this->Places.end(),
      [&](const Vec3& place) { return std::abs(plane.Distance(place)) <= SamePlane * size; }) &&
    std::all_of(this->Planes.begin(), this->Planes.end(),
      [&](const Plane& other) { return glm::dot(other.normal, plane.normal) > 0.0; });
}

/// Halves faces along the longest side of the box around their middles.
void LampSurface::AddCells(const std::vector<Vec3>& middles, std::uint32_t first,
  std::uint32_t last, std::vector<std::uint32_t>& order)
{
  const std::size_t cell = this->Cells.size();
  this->Cells.push_back({ first, last, 0, Vec3(0.0), Vec3(0.0) });
  if (last - first <= SmallCell)
  {
    return;
  }
  Bounds box;
  for (std::uint32_t k = first; k < last; ++k)
  {
    box.Add(middles[order[k]]);
  }
  const Vec3 extent = box.Extent();
  const int axis = extent.x >= std::max(extent.y, extent.z) ? 0 : (extent.y >= extent.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
    [&](std::uint32_t a, std::uint32_t b) { return middles[a][axis] < middles[b][axis]; });
  this->AddCells(middles, first, middle, order);
  this->Cells[cell].second = static_cast<std::uint32_t>(this->Cells.size());
  this->AddCells(middles, middle, last, order);
}

void LampSurface::AddCorners(
  const std::vector<Polygon>& faces, const std::vector<std::uint32_t>& order)
{
  std::map<Vec3, std::uint32_t, IsBefore> known;
  for (const std::uint32_t face : order)
  {
    this->FirstCorner.push_back(static_cast<std::uint32_t>(this->CornerOfFace.size()));
    for (const Vec3& place : faces[face])
    {
      const auto [corner, isNew] =
        known.try_emplace(place, static_cast<std::uint32_t>(this->Places.size()));
      if (isNew)
      {
        this->Places.push_back(place);
      }
      this->CornerOfFace.push_back(corner->second);
    }
  }
  this->FirstCorner.push_back(static_cast<std::uint32_t>(this->CornerOfFace.size()));
}

Polygon LampSurface::Face(std::uint32_t face) const
{
  Polygon shape;
  for (std::uint32_t k = this->FirstCorner[face]; k < this->FirstCorner[face + 1]; ++k)
  {
    shape.Add(this->Places[this->CornerOfFace[k]]);
  }
  return shape;
}

/// Faces that share an edge run along it in opposite directions. Where one of them was cut by the
/// plane of a frame each may keep its own: they cancel out in the sum.
void LampSurface::FindEdges()
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> open;
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    const std::uint32_t first = this->FirstCorner[f];
    const std::uint32_t last = this->FirstCorner[f + 1];
    for (std::uint32_t k = first; k < last; ++k)
    {
      const std::uint32_t from = this->CornerOfFace[k];
      const std::uint32_t to = this->CornerOfFace[k + 1 < last ? k + 1 : first];
      const auto opposite = open.find({ to, from });
      if (opposite != open.end())
      {
        this->Edges[opposite->second].second = f;
        open.erase(opposite);
        continue;
      }
      open[{ from, to }] = this->Edges.size();
      this->Edges.push_back({ from, to, f, Nothing });
    }
  }
}

/// From the last cell to the first: halves come after the whole.
void LampSurface::FindBoxes()
{
  for (std::size_t k = this->Cells.size(); k-- > 0;)
  {
    Cell& cell = this->Cells[k];
    Bounds box;
    if (cell.second != 0)
    {
      for (const Cell& part : { this->Cells[k + 1], this->Cells[cell.second] })
      {
        box.Add(part.middle - part.half);
        box.Add(part.middle + part.half);
      }
    }
    else
    {
      for (std::uint32_t c = this->FirstCorner[cell.first]; c < this->FirstCorner[cell.last]; ++c)
      {
        box.Add(this->Places[this->CornerOfFace[c]]);
      }
    }
    cell.middle = 0.5 * (box.Low() + box.High());
    cell.half = 0.5 * box.Extent();
  }
}

LampSurface LampSurface::In(const PatchFrame& frame, double unit) const
{
  LampSurface local(*this);
  double low = 0.0;
  double high = 0.0;
  for (Vec3& place : local.Places)
  {
    place = frame.ToLocal(place) / unit;
    low = std::min(low, place.z);
    high = std::max(high, place.z);
  }
  if (high <= Touching)
  {
    return {};
  }
  if (low < -Touching)
  {
    return LampSurface(local.FacesAbove());
  }
  local.Turn(frame, unit);
  for (Vec3& place : local.Places)
  {
    place.z = std::max(place.z, 0.0);
  }
  local.FindBoxes();
  local.Only = LampKernel(local.Size() == 1 ? local.Face(0) : Polygon());
  return local;
}

/// What of each is above the plane z = 0.
std::vector<Polygon> LampSurface::FacesAbove() const
{
  std::vector<Polygon> faces;
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    Polygon face = ClipToFront(this->Face(f), Plane(), Touching);
    for (int i = 0; i < face.Size(); ++i)
    {
      face[i].z = std::max(face[i].z, 0.0);
    }
    if (!face.Empty())
    {
      faces.push_back(face);
    }
  }
  return faces;
}

/// Planes and middles to the coordinates of a frame.
void LampSurface::Turn(const PatchFrame& frame, double unit)
{
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    Plane& plane = this->Planes[f];
    plane.offset = -plane.Distance(frame.origin) / unit;
    plane.normal = { glm::dot(plane.normal, frame.x), glm::dot(plane.normal, frame.y),
      glm::dot(plane.normal, frame.z) };
    this->Middles[f] = frame.ToLocal(this->Middles[f]) / unit;
  }
}

bool LampSurface::IsInFrontOf(const Polygon& other) const
{
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    for (const Vec3& corner : other)
    {
      const double height = this->Planes[f].Distance(corner);
      if (height > 0.0 && height > LargestDent * glm::length(corner - this->Middles[f]))
      {
        return false;
      }
    }
  }
  return true;
}

bool LampSurface::FindSeen(const Vec2& x, Flags& seen) const
{
  seen.resize(this->Size());
  std::uint8_t any = 0;
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    const Plane& plane = this->Planes[f];
    seen[f] = plane.normal.x * x.x + plane.normal.y * x.y > plane.offset ? 1 : 0;
    any |= seen[f];
  }
  return any != 0;
}

double LampSurface::At(const Vec2& x, Workspace& room) const
{
  if (this->Size() == 1)
  {
    return this->Only.At(x);
  }
  return this->FindSeen(x, room.seen) ? this->OfSeen(x, room.seen) : 0.0;
}

double LampSurface::OfSeen(const Vec2& x, const Flags& seen) const
{
  return this->OfSeen(Vec3(x, 0.0), Vec3(0.0, 0.0, 1.0), seen);
}

double LampSurface::OfSeen(const Vec3& x, const Vec3& normal, const Flags& seen) const
{
  double sum = 0.0;
  for (const Edge& edge : this->Edges)
  {
    const bool isFirstSeen = seen[edge.first] != 0;
    const bool isSecondSeen = edge.second != Nothing && seen[edge.second] != 0;
    if (isFirstSeen != isSecondSeen)
    {
      const Vec3 from = this->Places[edge.from] - x;
      const Vec3 to = this->Places[edge.to] - x;
      const Vec3 along = to - from;
      const double wedge = glm::dot(glm::cross(along, from), normal);
      const double term =
        LambertTerm(glm::length(from), glm::length(to), glm::dot(along, along), wedge);
      sum += isFirstSeen ? term : -term;
    }
  }
  return std::clamp(0.5 * sum, 0.0, Pi);
}

bool LampSurface::FindOutline(Workspace& room, std::vector<Vec3>& outline) const
{
  room.next.assign(this->Places.size(), Nothing);
  std::size_t count = 0;
  std::uint32_t start = Nothing;
  for (const Edge& edge : this->Edges)
  {
    const bool isFirstSeen = room.seen[edge.first] != 0;
    const bool isSecondSeen = edge.second != Nothing && room.seen[edge.second] != 0;
    if (isFirstSeen != isSecondSeen)
    {
      start = isFirstSeen ? edge.from : edge.to;
      if (room.next[start] != Nothing)
      {
        return false; // two pieces meet in a corner
      }
      room.next[start] = isFirstSeen ? edge.to : edge.from;
      ++count;
    }
  }
  outline.clear();
  for (std::uint32_t corner = start; outline.size() < count; corner = room.next[corner])
  {
    if (corner == Nothing || (corner == start && !outline.empty()))
    {
      return false;
    }
    outline.push_back(this->Places[corner]);
  }
  return count > 0;
}

void LampSurface::Sort(
  const HalfSpace* sides, std::size_t count, Flags& flags, std::vector<std::uint32_t>& partly) const
{
  this->SortCell(0, sides, ~Bits(0) >> (MostHalfSpaces - count), flags, partly);
}

/// \param open the half-spaces that the cells above were not in as a whole
void LampSurface::SortCell(std::uint32_t index, const HalfSpace* sides, Bits open, Flags& flags,
  std::vector<std::uint32_t>& partly) const
{
  const Cell& cell = this->Cells[index];
  Bits across = 0;
  for (int s = 0; open >> s != 0; ++s)
  {
    if ((open >> s & 1) != 0)
    {
      const double middle = sides[s].Height(cell.middle);
      const double reach = glm::dot(glm::abs(sides[s].normal), cell.half + Touching);
      if (middle + reach <= 0.0)
      {
        return;
      }
      across |= Bits(middle - reach <= 0.0) << s;
    }
  }
  if (across == 0)
  {
    std::fill(flags.begin() + cell.first, flags.begin() + cell.last, std::uint8_t(0));
  }
  else if (cell.second != 0)
  {
    this->SortCell(index + 1, sides, across, flags, partly);
    this->SortCell(cell.second, sides, across, flags, partly);
  }
  else
  {
    for (std::uint32_t face = cell.first; face < cell.last; ++face)
    {
      this->SortFace(face, sides, across, flags, partly);
    }
  }
}

/// Corners that touch a plane are outside, so that neighbours have no overlap.
void LampSurface::SortFace(std::uint32_t face, const HalfSpace* sides, Bits open, Flags& flags,
  std::vector<std::uint32_t>& partly) const
{
  if (flags[face] == 0)
  {
    return;
  }
  bool isWhole = true;
  for (int s = 0; open >> s != 0; ++s)
  {
    if ((open >> s & 1) != 0)
    {
      const Vec3 size = glm::abs(sides[s].normal);
      const double least = Touching * (size.x + size.y + size.z);
      bool anyInside = false;
      for (std::uint32_t k = this->FirstCorner[face]; k < this->FirstCorner[face + 1]; ++k)
      {
        const bool isInside = sides[s].Height(this->Places[this->CornerOfFace[k]]) > least;
        anyInside = anyInside || isInside;
        isWhole = isWhole && isInside;
      }
      if (!anyInside)
      {
        return;
      }
    }
  }
  if (isWhole)
  {
    flags[face] = 0;
  }
  else
  {
    partly.push_back(face);
  }
}

double LampSurface::Onto(const Vec3& x, const Vec3& normal, Workspace& room) const
{
  room.seen.resize(this->Size());
  bool any = false;
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    room.seen[f] = this->Planes[f].Distance(x) > 0.0 ? 1 : 0;
    any = any || room.seen[f] != 0;
  }
  if (!any)
  {
    return 0.0;
  }
  const Cell& all = this->Cells[0];
  const double height = glm::dot(normal, all.middle - x);
  const double reach = glm::dot(glm::abs(normal), all.half);
  if (height + reach <= 0.0)
  {
    return 0.0;
  }
  const double crossing = height < reach ? this->AcrossHorizon(x, normal, room) : 0.0;
  return std::min(crossing + this->OfSeen(x, normal, room.seen), Pi);
}

/// Takes the flags of faces that are not above the horizon as a whole, and returns what is received
/// from those of them that are in part.
double LampSurface::AcrossHorizon(const Vec3& x, const Vec3& normal, Workspace& room) const
{
  double sum = 0.0;
  for (std::uint32_t f = 0; f < this->Size(); ++f)
  {
    bool anyAbove = false;
    bool anyBelow = false;
    for (std::uint32_t k = this->FirstCorner[f]; k < this->FirstCorner[f + 1]; ++k)
    {
      const bool isAbove = glm::dot(normal, this->Places[this->CornerOfFace[k]] - x) > 0.0;
      anyAbove = anyAbove || isAbove;
      anyBelow = anyBelow || !isAbove;
    }
    if (room.seen[f] != 0 && anyBelow)
    {
      room.seen[f] = 0;
      sum += anyAbove ? PointToPolygon(x, normal, this->Face(f)) : 0.0;
    }
  }
  return sum;
}

} // namespace vantage
