#pragma once

#include "core/math/Sampling.h"
#include "core/scene/Scene.h"

#include <array>
#include <cstdint>

/// \file LabyrinthParts.h
/// What the rooms of Labyrinth.h are made of and furnished with.

namespace vantage
{

inline constexpr double LabyrinthRoomSize = 4.0;   ///< m
inline constexpr double LabyrinthRoomHeight = 2.8; ///< m

/// Materials of a labyrinth; the wall colours begin at FirstWall.
struct LabyrinthMaterial
{
  enum Id : std::uint32_t
  {
    Floor,
    Ceiling,
    Lamp,
    TableTop,
    TableLeg,
    Cupboard,
    Crate,
    FirstWall
  };
};

/// In the order of LabyrinthMaterial; lamps emit `lampRadiance`, W m^-2 sr^-1.
std::vector<Material> MakeLabyrinthMaterials(double lampRadiance);

/// A whole number in [0, n). \pre n > 0
int RandomBelow(int n, RandomStream& random);
double RandomBetween(double low, double high, RandomStream& random);

/// Rounds to whole millimetres: the last bits of the arithmetic before, which may differ between
/// machines (fused multiply-add), do not matter then.
double ToMillimetres(double x);

/// Adds parts to a scene, z up, in metres, all on whole millimetres. Solid parts have no bottom
/// where they stand on the floor, and their materials are one-sided.
class LabyrinthParts
{
public:
  /// The scene must outlive this object and have the materials above.
  explicit LabyrinthParts(Scene& scene)
    : Result(scene)
  {
  }

  void AddPolygon(std::vector<Vec3> points, std::uint32_t material);
  /// A rectangle at height z that faces up, or down.
  void AddLevel(const Vec2& low, const Vec2& high, double z, bool facesUp, std::uint32_t material);

  /// A closed slab on four thin legs, about in the middle of a room: ten polygons.
  void AddTable(const Vec2& centreOfRoom, RandomStream& random);
  /// Corner 0 .. 3 of a room: (-,-), (+,-), (-,+), (+,+). Five polygons that keep clear of the
  /// walls, and of all that is farther than 0.9 m from the corner along a wall.
  void AddCupboard(const Vec2& centreOfRoom, int corner, RandomStream& random);
  void AddCrate(const Vec2& centreOfRoom, int corner, RandomStream& random);
  /// A crate about in the middle of a room, turned by any angle: five polygons.
  void AddTurnedCrate(const Vec2& centreOfRoom, RandomStream& random);

private:
  /// Sides and top over a base that is counter-clockwise from above.
  void AddPrism(const std::array<Vec2, 4>& base, double low, double high, std::uint32_t material);
  void AddToCorner(
    const Vec2& centreOfRoom, int corner, const Vec2& size, double height, std::uint32_t material);

  Scene& Result;
};

} // namespace vantage
