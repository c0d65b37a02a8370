#pragma once

#include "core/scene/Labyrinth.h"

/// \file Rooms.h
/// Something to look around in.

namespace vantage::test
{

/// Four rooms, with two cameras.
inline Scene MakeRooms()
{
  LabyrinthSettings settings;
  settings.rows = 2;
  settings.columns = 2;
  return MakeLabyrinth(settings);
}

} // namespace vantage::test
