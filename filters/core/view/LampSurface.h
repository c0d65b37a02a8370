#pragma once

#include "core/view/LampKernel.h"
#include "core/view/PatchFrame.h"

#include <cstdint>
#include <vector>

/// \file LampSurface.h
/// What a plane receives from a lamp that was cut into many facets.

namespace vantage
{

/// Polygons of which none hides another from where its front is seen: one lamp, or parts of the
/// surface of a convex one. The edges between two that are both seen add nothing, so what a globe
/// of five hundred facets gives is a sum over the forty edges of its outline.
class LampSurface
{
public:
  LampSurface() = default;
  /// \param faces each with an area, counter-clockwise from the side that shines. They get another
  /// order. O(n log n).
  explicit LampSurface(const std::vector<Polygon>& faces);

  /// What of it is in front of the plane of a frame, in its coordinates over `unit`. O(n), but for
  /// lamps that cross the plane.
  LampSurface In(const PatchFrame& frame, double unit) const;

  std::uint32_t Size() const { return static_cast<std::uint32_t>(this->Planes.size()); }
  Polygon Face(std::uint32_t face) const;
  const Plane& PlaneOf(std::uint32_t face) const { return this->Planes[face]; }
  /// Where faces have corners, each once.
  const std::vector<Vec3>& Corners() const { return this->Places; }
  /// Whether all are in one plane, and turned to the same side.
  bool IsFlat() const { return this->Flat; }
  /// Whether a polygon is behind all faces: it hides nothing of any from where its front is seen.
  /// Corners may stand out by `LargestDent`.
  bool IsInFrontOf(const Polygon& other) const;

  /// Sine of the angle by which corners may stand out in front of a plane of its surface, seen from
  /// the middle of the face: coordinates are rounded in files. Who is not nearer to the plane than
  /// that sees all of the face in spite of them, and others see next to nothing of it.
  static constexpr double LargestDent = 2e-3;
  /// In the units of a patch's frame: what is nearer to a plane than this touches it.
  static constexpr double Touching = 1e-10;

  /// A flag for each face.
  using Flags = std::vector<std::uint8_t>;
  /// Room that a thread needs while it asks for one point after the other.
  struct Workspace
  {
    Flags seen;
    std::vector<std::uint32_t> next; ///< corner of an outline after each
  };

  /// What a point anywhere, with a unit normal, receives from all, in sr. Flags in room.seen those
  /// that it sees as a whole, but for the horizon.
  double Onto(const Vec3& x, const Vec3& normal, Workspace& room) const;

  /// The following are for what In() gives, and points of the plane z = 0.

  /// Which faces turn their front to x; returns whether any does.
  bool FindSeen(const Vec2& x, Flags& seen) const;
  /// What x receives from all, in sr.
  double At(const Vec2& x, Workspace& room) const;
  /// From the faces with a flag, all of which x sees. \pre there are some faces
  double OfSeen(const Vec2& x, const Flags& seen) const;

  /// The corners around those faces that room.seen flags, counter-clockwise; false where they are
  /// not around a single piece without a hole.
  bool FindOutline(Workspace& room, std::vector<Vec3>& outline) const;

  static constexpr std::size_t MostHalfSpaces = 64;
  /// dot(normal, y) + offset > 0.
  struct HalfSpace
  {
    Vec3 normal;
    double offset;

    double Height(const Vec3& y) const { return glm::dot(this->normal, y) + this->offset; }
  };
  /// Takes the flags of faces that are in all of some half-spaces as a whole, and appends to
  /// `partly` each that has a flag and may be in all of them in part.
  /// \pre MostHalfSpaces at most
  void Sort(const HalfSpace* sides, std::size_t count, Flags& flags,
    std::vector<std::uint32_t>& partly) const;

private:
  /// Between two faces, or a face and nothing.
  struct Edge
  {
    std::uint32_t from, to; ///< corners, in the order of the first face
    std::uint32_t first, second;
  };
  /// Faces that lie together, and the box around them. The first half of them is in the next cell.
  struct Cell
  {
    std::uint32_t first, last;
    std::uint32_t second; ///< the cell of the other half; 0: none
    Vec3 middle, half;    ///< of the box
  };

  using Bits = std::uint64_t; ///< one for each of some half-spaces

  void SortCell(std::uint32_t cell, const HalfSpace* sides, Bits open, Flags& flags,
    std::vector<std::uint32_t>& partly) const;
  void SortFace(std::uint32_t face, const HalfSpace* sides, Bits open, Flags& flags,
    std::vector<std::uint32_t>& partly) const;
  void AddCells(const std::vector<Vec3>& middles, std::uint32_t first, std::uint32_t last,
    std::vector<std::uint32_t>& order);
  void AddCorners(const std::vector<Polygon>& faces, const std::vector<std::uint32_t>& order);
  void FindEdges();
  void FindBoxes();
  std::vector<Polygon> FacesAbove() const;
  double AcrossHorizon(const Vec3& x, const Vec3& normal, Workspace& room) const;
  double OfSeen(const Vec3& x, const Vec3& normal, const Flags& seen) const;
  void Turn(const PatchFrame& frame, double unit);

  std::vector<Vec3> Places;
  std::vector<std::uint32_t> CornerOfFace;
  std::vector<std::uint32_t> FirstCorner; ///< of each face in CornerOfFace, and the end
  std::vector<Plane> Planes;              ///< of the faces
  std::vector<Vec3> Middles;              ///< of the faces
  std::vector<Edge> Edges;
  std::vector<Cell> Cells;
  LampKernel Only{ Polygon() }; ///< of the face, if there is one only
  bool Flat = true;
};

} // namespace vantage
