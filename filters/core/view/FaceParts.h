#pragma once

#include "core/view/LampSurface.h"

#include <array>
#include <cstddef>
#include <vector>

/// \file FaceParts.h
/// What is left of a face of a lamp past shadows.

namespace vantage
{

/// A convex polygon from which convex shadows are taken away one after the other. What is left is
/// kept in convex parts.
class FaceParts
{
public:
  /// The polygon, by the two coordinates in which its plane is steepest: the third one is linear in
  /// them.
  class Face
  {
  public:
    /// \pre the polygon has an area, and lies in the plane
    Face(const Polygon& shape, const Plane& plane);

  private:
    friend class FaceParts;
    int U, V, W;
    double PerU, PerV, Constant; ///< of the third coordinate
    std::array<Vec2, Polygon::Capacity> Corners;
    int Count = 0;
    double Sliver; ///< the area of a part that is not worth keeping
  };

  /// All of a face, which must outlive its parts.
  void Start(const Face& face);
  /// Takes away what is inside of all sides.
  void Take(const LampSurface::HalfSpace* sides, int count);
  std::size_t Size() const { return this->Parts.size(); }
  /// What x in the plane z = 0 receives from what is left, in sr. \pre x is in front of the face
  double At(const Vec2& x) const;

private:
  struct Part
  {
    std::array<Vec2, Polygon::Capacity> corners;
    int count = 0;
  };
  /// A shadow in the coordinates of the face.
  struct Shadow
  {
    struct Side
    {
      Vec2 normal;
      double offset; ///< inside where dot(normal, y) + offset > 0
    };
    std::array<Side, Polygon::Capacity + 1> sides;
    int count = 0;
  };
  using Heights = std::array<double, Polygon::Capacity>; ///< of the corners of a part

  Shadow OnFace(const LampSurface::HalfSpace* sides, int count) const;
  static void CutAt(const Part& whole, const Heights& heights, double side, Part& cut);
  static double Area(const Vec2* corners, int count);
  void AppendOutside(const Part& part, const Shadow& shadow);

  const Face* Whole = nullptr;
  std::vector<Part> Parts;
  std::vector<Part> Rest; ///< past one more shadow
};

} // namespace vantage
