#include "support/RandomRoom.h"

#include "support/SceneParts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vantage::test
{

namespace
{

/// The floor is dealt out in places, so that nothing meets anything else. The camera has the first.
constexpr int PlacesAlong = 3;

class RoomBuilder
{
public:
  explicit RoomBuilder(std::uint64_t seed)
    : Random(seed)
    , Size{ Between(3.0, 7.0, this->Random), Between(3.0, 7.0, this->Random),
      Between(2.4, 3.5, this->Random) }
  {
    for (int place = 1; place < PlacesAlong * PlacesAlong; ++place)
    {
      this->Places.push_back(place);
    }
    for (std::size_t i = this->Places.size() - 1; i > 0; --i)
    {
      std::swap(this->Places[i], this->Places[this->Below(static_cast<int>(i) + 1)]);
    }
  }

  Scene Build()
  {
    this->AddShell();
    const int pieces = this->Below(5);
    for (int i = 0; i < pieces; ++i)
    {
      this->AddFurniture(this->NextPlace());
    }
    const int panels = this->Below(3);
    for (int i = 0; i < panels; ++i)
    {
      this->AddHangingPanel(this->NextPlace(), 0.3, this->Parts.SurfaceMaterial(this->AnyAlbedo()));
    }
    // The first lamp hangs under the ceiling, so that no view is without light.
    this->AddCeilingLamp();
    const int more = this->Below(5);
    for (int i = 0; i < more; ++i)
    {
      this->AddAnyLamp();
    }
    const double eyeHeight = Between(1.2, 1.7, this->Random);
    const Vec3 eye(0.4, 0.4, eyeHeight);
    const Vec3 lookAt{ Between(0.5, 0.9, this->Random) * this->Size.x,
      Between(0.5, 0.9, this->Random) * this->Size.y, Between(0.2, 1.2, this->Random) };
    this->Parts.AddCamera("inside", eye, lookAt, Between(45.0, 75.0, this->Random));
    return std::move(this->Parts.scene);
  }

private:
  int Below(int n) { return std::min(n - 1, static_cast<int>(this->Random.Next() * n)); }
  Color AnyAlbedo() { return ColorBetween(0.05, 0.85, this->Random); }
  std::uint32_t AnyLamp()
  {
    const double strength = LogBetween(1.0, 100.0, this->Random);
    return this->Parts.LampMaterial(strength * ColorBetween(0.5, 1.0, this->Random));
  }

  int NextPlace()
  {
    const int place = this->Places.back();
    this->Places.pop_back();
    return place;
  }
  Vec2 PlaceSize() const { return Vec2(this->Size) / static_cast<double>(PlacesAlong); }
  Vec2 CentreOf(int place) const
  {
    const int row = place / PlacesAlong;
    return this->PlaceSize() * (Vec2(place % PlacesAlong, row) + 0.5);
  }
  /// The largest circle in a place has this radius.
  double Clearance() const { return 0.5 * std::min(this->PlaceSize().x, this->PlaceSize().y); }

  void AddShell()
  {
    const int kind = this->Below(4);
    const Vec2 far(this->Size);
    this->Parts.AddFloor(Vec2(0.0), far, 0.0, this->Parts.SurfaceMaterial(this->AnyAlbedo()));
    if (kind != 0)
    {
      this->Parts.AddCeiling(
        Vec2(0.0), far, this->Size.z, this->Parts.SurfaceMaterial(this->AnyAlbedo()));
    }
    // Those at the corner of the camera are never missing: it would see nothing there.
    const int missing = kind == 1 ? 1 + this->Below(2) : 4;
    const std::array<Vec2, 4> corners{ Vec2(0.0), Vec2(far.x, 0.0), far, Vec2(0.0, far.y) };
    for (int wall = 0; wall < 4; ++wall)
    {
      const std::uint32_t material = this->Parts.SurfaceMaterial(this->AnyAlbedo());
      if (wall != missing)
      {
        this->Parts.AddWall(corners[wall], corners[(wall + 1) % 4], this->Size.z, material);
      }
    }
  }

  void AddFurniture(int place)
  {
    const Vec2 size = this->Clearance() *
                      Vec2{ Between(0.4, 1.15, this->Random), Between(0.4, 1.15, this->Random) };
    const std::uint32_t material = this->Parts.SolidMaterial(this->AnyAlbedo());
    if (this->Random.Next() < 0.3)
    {
      this->Parts.AddTable(this->CentreOf(place), glm::max(size, Vec2(0.3)),
        Between(0.5, 0.9, this->Random), material);
    }
    else
    {
      const double turn = 2.0 * Pi * this->Random.Next();
      this->Parts.AddBlock(
        Vec3(this->CentreOf(place), 0.0), size, turn, LogBetween(0.2, 2.0, this->Random), material);
    }
  }

  /// About the middle of a place and of the height, turned any way, within the given radius.
  void AddHangingPanel(int place, double radius, std::uint32_t material)
  {
    const double height = 2.0 * this->Random.Next() - 1.0;
    const double turn = 2.0 * Pi * this->Random.Next();
    const double ring = std::sqrt(1.0 - height * height);
    const Frame frame(Vec3(ring * std::cos(turn), ring * std::sin(turn), height));
    const double angle = Between(0.15, 0.35, this->Random) * Pi;
    const Vec3 x = radius * std::cos(angle) * frame.x;
    const Vec3 y = radius * std::sin(angle) * frame.y;
    const Vec3 centre(this->CentreOf(place), 0.6 * this->Size.z);
    this->Parts.AddPanel(centre - x - y, 2.0 * x, 2.0 * y, material);
  }

  void AddCeilingLamp()
  {
    const Vec2 size{ LogBetween(0.05, 1.2, this->Random), LogBetween(0.05, 1.2, this->Random) };
    const Vec2 margin = 0.5 * size + Vec2(0.1);
    const Vec2 centre = margin + (Vec2(this->Size) - 2.0 * margin) * this->Random.Next2();
    const double drop = 0.02 + 0.03 * static_cast<double>(this->CeilingLamps++);
    this->Parts.AddDownward(Vec3(centre, this->Size.z - drop), size, this->AnyLamp());
  }

  /// Upright, a little off the wall at x = 0 or y = 0.
  void AddWallLamp()
  {
    const int axis = this->Below(2);
    const double width = LogBetween(0.05, 1.0, this->Random);
    const double height = LogBetween(0.05, 0.5, this->Random);
    const double off = 0.02 + 0.02 * static_cast<double>(this->WallLamps++);
    const double along = Between(0.9, this->Size[axis] - 1.1, this->Random);
    const double z = Between(1.0, this->Size.z - 0.7, this->Random);
    Vec3 origin(off, off, z);
    origin[axis] = along;
    Vec3 side(0.0);
    side[axis] = width;
    const Vec3 up(0.0, 0.0, height);
    // The front looks into the room: z x x = y, y x z = x.
    this->Parts.AddPanel(origin, axis == 0 ? up : side, axis == 0 ? side : up, this->AnyLamp());
  }

  void AddAnyLamp()
  {
    const double kind = this->Random.Next();
    if (kind < 0.4 || this->Places.empty())
    {
      this->AddCeilingLamp();
    }
    else if (kind < 0.7)
    {
      this->AddWallLamp();
    }
    else
    {
      const double radius = LogBetween(0.05, 0.3, this->Random);
      this->AddHangingPanel(this->NextPlace(), radius, this->AnyLamp());
    }
  }

  RandomStream Random;
  Vec3 Size;
  std::vector<int> Places; ///< free ones
  int CeilingLamps = 0;
  int WallLamps = 0;
  SceneParts Parts;
};

} // namespace

Scene MakeRandomRoom(std::uint64_t seed)
{
  return RoomBuilder(seed).Build();
}

} // namespace vantage::test
