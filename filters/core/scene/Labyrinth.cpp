#include "core/scene/Labyrinth.h"

#include "core/Error.h"
#include "core/scene/LabyrinthParts.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>

namespace vantage
{

namespace
{

// Lengths in metres.
constexpr double DoorWidth = 1.0;
constexpr double DoorHeight = 2.1;
constexpr double DoorFromCorner = 0.9; // furniture in the corners leaves the doors free
constexpr double LampSize = 0.6;
constexpr double LampDrop = 0.05;
constexpr double EyeFromWall = 0.4;
constexpr double EyeHeight = 1.6;

/// Fisher and Yates.
template <typename T>
void Shuffle(std::vector<T>& list, RandomStream& random)
{
  for (int i = static_cast<int>(list.size()) - 1; i > 0; --i)
  {
    std::swap(list[i], list[RandomBelow(i + 1, random)]);
  }
}

/// A wall on a side of the grid's cells.
struct Wall
{
  int room;                   ///< in front of it
  int other;                  ///< behind it, or -1 at the perimeter
  Vec2 begin, end;            ///< along the floor, with the room in front on the left
  std::optional<double> door; ///< distance of the doorway from `begin`

  Vec2 Along(double distance) const
  {
    return this->begin + (this->end - this->begin) * (distance / LabyrinthRoomSize);
  }
};

/// Connected sets of rooms (union by halving paths).
class RoomSets
{
public:
  explicit RoomSets(int rooms)
    : Parent(rooms)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }

  /// False when the rooms are connected already.
  bool Join(int a, int b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parent[b] = a;
    return a != b;
  }

private:
  int Find(int room)
  {
    while (this->Parent[room] != room)
    {
      room = this->Parent[room] = this->Parent[this->Parent[room]];
    }
    return room;
  }

  std::vector<int> Parent;
};

class LabyrinthBuilder
{
public:
  explicit LabyrinthBuilder(const LabyrinthSettings& settings)
    : Settings(settings)
    , Rooms(settings.rows * settings.columns)
  {
  }

  Scene Build()
  {
    this->Result.materials = MakeLabyrinthMaterials(this->Settings.lampRadiance);
    this->PlaceWalls();
    this->CutDoors();
    for (const Wall& wall : this->Walls)
    {
      this->AddWall(wall);
    }
    for (int room = 0; room < this->Rooms; ++room)
    {
      this->AddFloorAndCeiling(room);
    }
    this->AddLamps();
    this->AddFurniture();
    this->AddView("view1", 0);
    this->AddView("view2", this->Rooms - 1);
    this->AddOverview();
    return std::move(this->Result);
  }

private:
  /// What random numbers are for; each purpose has its own stream.
  enum Purpose : std::uint64_t
  {
    Doors,
    Lamps,
    Furniture,
    Colours
  };

  RandomStream Random(Purpose purpose, int id = 0) const
  {
    return RandomStream(this->Settings.seed, purpose, id);
  }

  Vec2 CornerOf(int room) const
  {
    return { LabyrinthRoomSize * (room % this->Settings.columns),
      LabyrinthRoomSize * (room / this->Settings.columns) };
  }
  Vec2 CentreOf(int room) const { return this->CornerOf(room) + Vec2(0.5 * LabyrinthRoomSize); }

  /// Each room owns its walls to the south and to the west; the last ones the others as well.
  void PlaceWalls()
  {
    const int columns = this->Settings.columns;
    for (int room = 0; room < this->Rooms; ++room)
    {
      const Vec2 low = this->CornerOf(room);
      const Vec2 high = low + Vec2(LabyrinthRoomSize);
      const bool isFirstColumn = room % columns == 0;
      const bool isFirstRow = room < columns;
      this->Walls.push_back({ room, isFirstRow ? -1 : room - columns, low, { high.x, low.y }, {} });
      this->Walls.push_back({ room, isFirstColumn ? -1 : room - 1, { low.x, high.y }, low, {} });
      if (room % columns == columns - 1)
      {
        this->Walls.push_back({ room, -1, { high.x, low.y }, high, {} });
      }
      if (room + columns >= this->Rooms)
      {
        this->Walls.push_back({ room, -1, high, { low.x, high.y }, {} });
      }
    }
  }

  /// A random spanning tree of doors, then a part of the walls that are left.
  void CutDoors()
  {
    RandomStream random = this->Random(Doors);
    std::vector<int> inner;
    for (int w = 0; w < static_cast<int>(this->Walls.size()); ++w)
    {
      if (this->Walls[w].other >= 0)
      {
        inner.push_back(w);
      }
    }
    Shuffle(inner, random);
    RoomSets sets(this->Rooms);
    std::vector<int> chosen;
    std::vector<int> left;
    for (const int w : inner)
    {
      (sets.Join(this->Walls[w].room, this->Walls[w].other) ? chosen : left).push_back(w);
    }
    const auto extra = std::lround(this->Settings.extraDoors * static_cast<double>(left.size()));
    chosen.insert(chosen.end(), left.begin(), left.begin() + extra);
    for (const int w : chosen)
    {
      const double last = LabyrinthRoomSize - DoorFromCorner - DoorWidth;
      this->Walls[w].door = RandomBetween(DoorFromCorner, last, random);
    }
  }

  /// The part of a wall from distance `begin` to `end` and from height `low` to `high`.
  void AddPanel(
    const Wall& wall, double begin, double end, double low, double high, std::uint32_t material)
  {
    const Vec2 a = wall.Along(begin);
    const Vec2 b = wall.Along(end);
    this->Parts.AddPolygon({ { b, low }, { a, low }, { a, high }, { b, high } }, material);
  }

  void AddWall(const Wall& wall)
  {
    RandomStream random = this->Random(Colours, static_cast<int>(&wall - this->Walls.data()));
    const int colours =
      static_cast<int>(this->Result.materials.size()) - LabyrinthMaterial::FirstWall;
    const auto material =
      static_cast<std::uint32_t>(LabyrinthMaterial::FirstWall + RandomBelow(colours, random));
    if (!wall.door)
    {
      this->AddPanel(wall, 0.0, LabyrinthRoomSize, 0.0, LabyrinthRoomHeight, material);
      return;
    }
    const double begin = *wall.door;
    const double end = begin + DoorWidth;
    this->AddPanel(wall, 0.0, begin, 0.0, LabyrinthRoomHeight, material);
    this->AddPanel(wall, end, LabyrinthRoomSize, 0.0, LabyrinthRoomHeight, material);
    this->AddPanel(wall, begin, end, DoorHeight, LabyrinthRoomHeight, material);
  }

  void AddFloorAndCeiling(int room)
  {
    const Vec2 low = this->CornerOf(room);
    this->Parts.AddLevel(low, low + Vec2(LabyrinthRoomSize), 0.0, true, LabyrinthMaterial::Floor);
    this->Parts.AddLevel(
      low, low + Vec2(LabyrinthRoomSize), LabyrinthRoomHeight, false, LabyrinthMaterial::Ceiling);
  }

  bool HasView(int room) const { return room == 0 || room == this->Rooms - 1; }

  void AddLamps()
  {
    std::vector<int> rooms(this->Rooms);
    std::iota(rooms.begin(), rooms.end(), 0);
    RandomStream random = this->Random(Lamps);
    Shuffle(rooms, random);
    // The rooms of the views come last, so that the dark ones are taken from the others.
    std::stable_partition(
      rooms.begin(), rooms.end(), [&](int room) { return !this->HasView(room); });
    const int views = std::min(2, this->Rooms);
    const auto dark = std::lround(this->Settings.darkRooms * this->Rooms);
    rooms.erase(rooms.begin(), rooms.begin() + std::min<long>(dark, this->Rooms - views));
    std::sort(rooms.begin(), rooms.end());
    for (const int room : rooms)
    {
      const Vec2 centre = this->CentreOf(room);
      const double z = LabyrinthRoomHeight - LampDrop;
      this->Parts.AddLevel(centre - Vec2(0.5 * LampSize), centre + Vec2(0.5 * LampSize), z, false,
        LabyrinthMaterial::Lamp);
    }
  }

  /// The four ways of furnishing are dealt in turn, so that their mixture does not depend on the
  /// seed; which room gets which does.
  void AddFurniture()
  {
    std::vector<int> kinds(this->Rooms);
    for (int room = 0; room < this->Rooms; ++room)
    {
      kinds[room] = room % 4;
    }
    RandomStream random = this->Random(Furniture);
    Shuffle(kinds, random);
    // The views show a table: swap with the next room that has one.
    for (const int room : { 0, this->Rooms - 1 })
    {
      const int step = room == 0 ? 1 : -1;
      int other = room;
      while (kinds[other] > 1 && other + step >= 0 && other + step < this->Rooms)
      {
        other += step;
      }
      std::swap(kinds[room], kinds[other]);
    }
    for (int room = 0; room < this->Rooms; ++room)
    {
      RandomStream roomRandom = this->Random(Furniture, room + 1);
      this->FurnishRoom(room, kinds[room], roomRandom);
    }
  }

  void FurnishRoom(int room, int kind, RandomStream& random)
  {
    const Vec2 centre = this->CentreOf(room);
    const int corner = this->HasView(room) ? this->CornerForView(room) : RandomBelow(4, random);
    switch (kind)
    {
      case 0:
        this->Parts.AddTable(centre, random);
        break;
      case 1:
        this->Parts.AddTable(centre, random);
        this->Parts.AddCupboard(centre, corner, random);
        break;
      case 2:
        this->Parts.AddCupboard(centre, corner, random);
        this->Parts.AddCrate(centre, 3 - corner, random);
        break;
      default:
        this->Parts.AddCrate(centre, corner, random);
        this->Parts.AddTurnedCrate(centre, random);
        break;
    }
  }

  /// What a view looks at: the middle of the first doorway of the room, or of a wall.
  Vec2 TargetOfView(int room) const
  {
    for (const Wall& wall : this->Walls)
    {
      if (wall.door && (wall.room == room || wall.other == room))
      {
        return wall.Along(*wall.door + 0.5 * DoorWidth);
      }
    }
    return this->CornerOf(room) + Vec2(LabyrinthRoomSize, 0.5 * LabyrinthRoomSize);
  }

  /// The corner of the room farthest from what the view looks at.
  int EyeCorner(int room) const
  {
    const Vec2 toward = this->TargetOfView(room) - this->CentreOf(room);
    return (toward.x > 0.0 ? 0 : 1) + (toward.y > 0.0 ? 0 : 2);
  }

  /// Where furniture is seen and neither hides the eye nor the doorway: beside the target.
  int CornerForView(int room) const { return 3 - this->EyeCorner(room); }

  void AddView(const std::string& name, int room)
  {
    const int corner = this->EyeCorner(room);
    const double inside = 0.5 * LabyrinthRoomSize - EyeFromWall;
    const Vec2 eye = this->CentreOf(room) +
                     Vec2(corner % 2 == 0 ? -inside : inside, corner < 2 ? -inside : inside);
    Camera camera;
    camera.name = name;
    camera.eye = Vec3(ToMillimetres(eye.x), ToMillimetres(eye.y), EyeHeight);
    const Vec2 target = this->TargetOfView(room);
    camera.lookAt = Vec3(ToMillimetres(target.x), ToMillimetres(target.y), 1.1);
    camera.up = Vec3(0.0, 0.0, 1.0);
    camera.fieldOfView = 60.0;
    camera.aspect = 4.0 / 3.0;
    this->Result.cameras.push_back(camera);
  }

  void AddOverview()
  {
    const Vec2 size = LabyrinthRoomSize * Vec2(this->Settings.columns, this->Settings.rows);
    const double extent = std::max(size.x, size.y);
    Camera camera;
    camera.name = "overview";
    camera.lookAt = Vec3(0.5 * size, 0.0);
    camera.eye = camera.lookAt + extent * Vec3(-0.25, -0.75, 1.0);
    camera.up = Vec3(0.0, 0.0, 1.0);
    camera.fieldOfView = 45.0;
    camera.aspect = 4.0 / 3.0;
    this->Result.cameras.push_back(camera);
  }

  const LabyrinthSettings& Settings;
  int Rooms;
  std::vector<Wall> Walls;
  Scene Result;
  LabyrinthParts Parts{ Result };
};

void CheckRange(const char* name, double value, double low, double high)
{
  if (!(value >= low && value <= high))
  {
    throw InputError(std::string(name) + ": it is " + std::to_string(value) +
                     "; choose a value between " + std::to_string(low) + " and " +
                     std::to_string(high));
  }
}

} // namespace

void LabyrinthSettings::Validate() const
{
  CheckRange("rows", this->rows, 1, 1000);
  CheckRange("columns", this->columns, 1, 1000);
  CheckRange("extraDoors", this->extraDoors, 0.0, 1.0);
  CheckRange("darkRooms", this->darkRooms, 0.0, 1.0);
  CheckRange("lampRadiance", this->lampRadiance, 0.0, 1e12);
}

Scene MakeLabyrinth(const LabyrinthSettings& settings)
{
  settings.Validate();
  return LabyrinthBuilder(settings).Build();
}

} // namespace vantage
