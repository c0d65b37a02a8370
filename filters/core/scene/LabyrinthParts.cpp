#include "core/scene/LabyrinthParts.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr double WallGap = 0.05; // m, between furniture and wall

Material MakeMaterial(const char* name, const Color& albedo, bool twoSided = true)
{
  Material m;
  m.name = name;
  m.albedo = albedo;
  m.twoSided = twoSided;
  return m;
}

std::array<Vec2, 4> Rectangle(const Vec2& low, const Vec2& high)
{
  return { low, Vec2(high.x, low.y), high, Vec2(low.x, high.y) };
}

} // namespace

std::vector<Material> MakeLabyrinthMaterials(double lampRadiance)
{
  std::vector<Material> materials = { MakeMaterial("floor", { 0.5, 0.42, 0.34 }),
    MakeMaterial("ceiling", { 0.8, 0.8, 0.8 }), MakeMaterial("lamp", { 0.5, 0.5, 0.5 }),
    MakeMaterial("table-top", { 0.55, 0.4, 0.3 }, false),
    MakeMaterial("table-leg", { 0.45, 0.35, 0.3 }),
    MakeMaterial("cupboard", { 0.6, 0.45, 0.35 }, false),
    MakeMaterial("crate", { 0.4, 0.45, 0.5 }, false),
    MakeMaterial("wall-white", { 0.75, 0.75, 0.72 }),
    MakeMaterial("wall-ochre", { 0.75, 0.62, 0.4 }), MakeMaterial("wall-green", { 0.5, 0.68, 0.5 }),
    MakeMaterial("wall-blue", { 0.45, 0.55, 0.7 }), MakeMaterial("wall-red", { 0.7, 0.42, 0.38 }) };
  materials[LabyrinthMaterial::Lamp].emission = Color(lampRadiance);
  return materials;
}

int RandomBelow(int n, RandomStream& random)
{
  return std::min(n - 1, static_cast<int>(random.Next() * n));
}

double RandomBetween(double low, double high, RandomStream& random)
{
  return low + (high - low) * random.Next();
}

double ToMillimetres(double x)
{
  return std::round(x * 1000.0) / 1000.0;
}

void LabyrinthParts::AddPolygon(std::vector<Vec3> points, std::uint32_t material)
{
  for (Vec3& p : points)
  {
    p = { ToMillimetres(p.x), ToMillimetres(p.y), ToMillimetres(p.z) };
  }
  this->Result.AddPolygon(points, material);
}

void LabyrinthParts::AddLevel(
  const Vec2& low, const Vec2& high, double z, bool facesUp, std::uint32_t material)
{
  std::vector<Vec3> corners = { { low, z }, { high.x, low.y, z }, { high, z },
    { low.x, high.y, z } };
  if (!facesUp)
  {
    std::reverse(corners.begin(), corners.end());
  }
  this->AddPolygon(corners, material);
}

void LabyrinthParts::AddPrism(
  const std::array<Vec2, 4>& base, double low, double high, std::uint32_t material)
{
  for (int k = 0; k < 4; ++k)
  {
    const Vec2& a = base[k];
    const Vec2& b = base[(k + 1) % 4];
    this->AddPolygon({ { a, low }, { b, low }, { b, high }, { a, high } }, material);
  }
  this->AddPolygon(
    { { base[0], high }, { base[1], high }, { base[2], high }, { base[3], high } }, material);
}

void LabyrinthParts::AddTable(const Vec2& centreOfRoom, RandomStream& random)
{
  Vec2 half{ RandomBetween(0.6, 0.75, random), RandomBetween(0.35, 0.45, random) };
  if (random.Next() < 0.5)
  {
    std::swap(half.x, half.y);
  }
  const Vec2 shift{ RandomBetween(-0.3, 0.3, random), RandomBetween(-0.3, 0.3, random) };
  const Vec2 low = centreOfRoom + shift - half;
  const Vec2 high = centreOfRoom + shift + half;
  constexpr double Top = 0.75;
  constexpr double Bottom = 0.71;
  this->AddPrism(Rectangle(low, high), Bottom, Top, LabyrinthMaterial::TableTop);
  this->AddLevel(low, high, Bottom, false, LabyrinthMaterial::TableTop);
  for (int corner = 0; corner < 4; ++corner)
  {
    constexpr double Inset = 0.06;
    constexpr double LegWidth = 0.08;
    const double side = corner % 2 == 0 ? 1.0 : -1.0;
    const double x = corner % 2 == 0 ? low.x + Inset : high.x - Inset;
    const double y = corner < 2 ? low.y + Inset : high.y - Inset;
    this->AddPolygon({ { x, y, 0.0 }, { x + side * LegWidth, y, 0.0 },
                       { x + side * LegWidth, y, Bottom }, { x, y, Bottom } },
      LabyrinthMaterial::TableLeg);
  }
}

void LabyrinthParts::AddToCorner(
  const Vec2& centreOfRoom, int corner, const Vec2& size, double height, std::uint32_t material)
{
  const Vec2 free(
    LabyrinthRoomSize - 2.0 * WallGap - size.x, LabyrinthRoomSize - 2.0 * WallGap - size.y);
  const Vec2 low = centreOfRoom - Vec2(0.5 * LabyrinthRoomSize - WallGap) +
                   Vec2(corner % 2 == 0 ? 0.0 : free.x, corner < 2 ? 0.0 : free.y);
  this->AddPrism(Rectangle(low, low + size), 0.0, height, material);
}

void LabyrinthParts::AddCupboard(const Vec2& centreOfRoom, int corner, RandomStream& random)
{
  Vec2 size{ RandomBetween(0.65, 0.8, random), RandomBetween(0.35, 0.45, random) };
  if (random.Next() < 0.5)
  {
    std::swap(size.x, size.y);
  }
  this->AddToCorner(
    centreOfRoom, corner, size, RandomBetween(1.6, 2.0, random), LabyrinthMaterial::Cupboard);
}

void LabyrinthParts::AddCrate(const Vec2& centreOfRoom, int corner, RandomStream& random)
{
  const Vec2 size{ RandomBetween(0.4, 0.7, random), RandomBetween(0.4, 0.7, random) };
  this->AddToCorner(
    centreOfRoom, corner, size, RandomBetween(0.4, 0.9, random), LabyrinthMaterial::Crate);
}

void LabyrinthParts::AddTurnedCrate(const Vec2& centreOfRoom, RandomStream& random)
{
  const double half = RandomBetween(0.25, 0.4, random);
  const Vec2 shift{ RandomBetween(-0.5, 0.5, random), RandomBetween(-0.5, 0.5, random) };
  const Vec2 centre = centreOfRoom + shift;
  // Rational parameters of the quarter circle need no library's sine.
  const double t = random.Next();
  const Vec2 x = Vec2(1.0 - t * t, 2.0 * t) * (half / (1.0 + t * t));
  const Vec2 y(-x.y, x.x);
  this->AddPrism({ centre - x - y, centre + x - y, centre + x + y, centre - x + y }, 0.0,
    RandomBetween(0.4, 0.9, random), LabyrinthMaterial::Crate);
}

} // namespace vantage
