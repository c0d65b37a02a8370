#pragma once

#include "core/view/LampSurface.h"

#include <cstddef>
#include <vector>

/// \file FaceParts.h
/// What is left of a lamp past shadows.

namespace vantage
{

/// A convex polygon from which convex shadows are taken away one after the other. What is left is
/// kept in convex parts.
class FaceParts
{
public:
  /// The polygon, by two coordinates u and v in its plane: (u, v) is at origin + u alongU + v
  /// alongV.
  class Face
  {
  public:
    Face() = default;
    /// u and v are two coordinates of space, the third one is linear in them.
    /// \pre the polygon has an area, and lies in the plane
    Face(const Polygon& shape, const Plane& plane);

    /// Another polygon, of no corners yet.
    void Start(const Vec3& origin, const Vec3& alongU, const Vec3& alongV);
    void Add(const Vec2& corner) { this->Corners.push_back(corner); }
    const std::vector<Vec2>& CornersInPlane() const { return this->Corners; }

  private:
    friend class FaceParts;
    Vec3 Origin, AlongU, AlongV;
    std::vector<Vec2> Corners;
  };

  /// All of a face, which must outlive its parts.
  void Start(const Face& face);
  /// Takes away what is inside of all sides.
  void Take(const LampSurface::HalfSpace* sides, std::size_t count);
  std::size_t Size() const { return this->Parts.parts.size(); }
  /// What x in the plane z = 0 receives from what is left, in sr. \pre x is in front of the face
  double At(const Vec2& x);

private:
  struct Part
  {
    std::size_t first, count; ///< corners
  };
  /// Parts, and their corners one after the other.
  struct PartList
  {
    std::vector<Part> parts;
    std::vector<Vec2> corners;
  };
  /// The corners of a part, wherever they are.
  struct Span
  {
    const Vec2* first;
    std::size_t count;
  };
  /// Inside where dot(normal, y) + offset > 0, in the coordinates of the face.
  struct Side
  {
    Vec2 normal;
    double offset;
  };

  void CutAt(const Span& whole, double side, std::vector<Vec2>& cut) const;
  static double Area(const Span& part);
  std::size_t FindHeights(const Span& part, const Side& side);
  void AppendOutside(const Span& part);

  const Face* Whole = nullptr;
  double Sliver = 0.0; ///< the area of a part that is not worth keeping
  PartList Parts;
  PartList Rest; ///< past one more shadow
  // Room for one shadow.
  std::vector<Side> Sides;
  std::vector<double> Heights; ///< of the corners of a part over a side
  std::vector<Vec2> Inside[2]; ///< what is inside of the sides so far, and of the next one
  std::vector<Vec3> Places;    ///< of the corners of a part, from x
  std::vector<double> Lengths; ///< of these
};

} // namespace vantage
