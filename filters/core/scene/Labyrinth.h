#pragma once

#include "core/scene/Scene.h"

#include <cstdint>

/// \file Labyrinth.h
/// The family of scenes that importance is made for: many rooms, of which a camera sees few
/// (the labyrinth of Bekaert and Willems 1995).

namespace vantage
{

struct LabyrinthSettings
{
  int rows = 4;                  ///< rooms along y, 1 .. 1000
  int columns = 5;               ///< rooms along x, 1 .. 1000
  std::uint64_t seed = 1;        ///< of doors, colours and furniture
  double extraDoors = 1.0 / 3.0; ///< part of the walls without a needed door that get one, [0, 1]
  double darkRooms = 0.1; ///< part of the rooms without a lamp, [0, 1]; never those of the views
  double lampRadiance = 60.0; ///< W m^-2 sr^-1, >= 0; 60 gives some 3 W/m^2 below the lamp,
                              ///< about 500 lux of white light

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// A grid of closed rooms, 4 x 4 m and 2.8 m high, z up, the first with its corner at the origin.
/// Every room has a floor, a ceiling and walls that meet exactly; walls have no thickness and are
/// shared by the rooms on both sides. Doorways, 1 x 2.1 m, have wall on both sides and above; a
/// random spanning tree of them (Kruskal 1956) joins all rooms, a few more make loops. Lamps of
/// 0.6 x 0.6 m hang 5 cm below the ceilings and shine down. Tables, cupboards and crates stand
/// free: no two faces coincide, no furniture blocks a doorway. Materials of solid furniture are
/// one-sided, all others two-sided; albedos lie between 0.3 and 0.8.
///
/// The number of polygons depends on rows and columns only: 378 for 4 x 5 rooms, as in the paper.
/// Coordinates are whole millimetres, the same to the bit on all machines. O(rows columns).
///
/// Cameras: `view1` in the first room and `view2` in the last one look from 1.6 m height past a
/// table through a doorway; `overview` looks from outside obliquely down on the whole (for pictures
/// where the ceilings, which face down, are culled).
/// \throw InputError as LabyrinthSettings::Validate.
Scene MakeLabyrinth(const LabyrinthSettings& settings = {});

} // namespace vantage
