#include "core/reference/ReferenceImage.h"

#include "core/math/Sampling.h"
#include "core/reference/LightMap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

namespace vantage
{

namespace
{

/// Changes whenever the way references are made does, so that old files are not taken for new ones.
constexpr std::uint64_t Recipe = 3;

constexpr int Halves = 2;

/// How many of so many pixels in a row are taken, from the one half a stride in.
int EveryAlong(int pixels, int stride)
{
  return (pixels - stride / 2 + stride - 1) / stride;
}

/// What the pixel centres see.
class PixelGather
{
public:
  PixelGather(const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
    : Settings(settings)
    , Geometry(scene)
    , Columns(EveryAlong(ReferenceWidth(camera, settings), settings.stride))
    , Rows(EveryAlong(settings.size, settings.stride))
  {
    const ImagePlane plane(camera);
    const Vec2 scale = 2.0 / Vec2(ReferenceWidth(camera, settings), settings.size);
    for (int row = 0; row < this->Rows; ++row)
    {
      for (int column = 0; column < this->Columns; ++column)
      {
        const Vec2 pixel(settings.stride / 2 + column * settings.stride,
          settings.stride / 2 + row * settings.stride);
        const Vec2 at = (pixel + 0.5) * scale - 1.0;
        const auto hit = this->Geometry.occluders.Intersect(plane.eye, plane.Direction(at.x, at.y));
        this->Places.push_back(hit ? std::optional(this->Geometry.PlaceOf(*hit)) : std::nullopt);
      }
    }
    this->Direct.resize(this->Places.size());
    tbb::parallel_for(std::size_t{ 0 }, this->Places.size(),
      [&](std::size_t p)
      {
        if (const auto& place = this->Places[p])
        {
          this->Direct[p] =
            place->emission + place->albedo * this->Geometry.direct.At(place->hit, place->normal);
        }
      });
  }

  /// Few cells are as much a cause of noise as few rays: each has one point, in light or in
  /// shadow. What is exact stays.
  void Refine(int times)
  {
    this->Settings.gatherRays *= times;
    this->Settings.mapCells *= times;
  }

  /// `progress` runs from 0 to 1.
  ReferenceHalves Render(const ReferenceProgress& progress) const
  {
    ReferenceHalves images;
    for (int half = 0; half < Halves; ++half)
    {
      images.halves[half] = this->RenderHalf(
        static_cast<std::uint64_t>(half), [&](double part) { progress((half + part) / Halves); });
    }
    return images;
  }

private:
  int RaysOfHalf() const { return std::max(1, this->Settings.gatherRays / Halves); }

  /// Which points of the map the gather rays of each pixel that is a surface lead to.
  std::vector<std::uint32_t> TargetsOfPixels(
    LightMap& map, std::uint64_t seed, const ReferenceProgress& progress) const
  {
    std::vector<std::uint32_t> targets;
    const auto columns = static_cast<std::size_t>(this->Columns);
    for (int row = 0; row < this->Rows; ++row)
    {
      progress(static_cast<double>(row) / this->Rows);
      std::vector<std::vector<std::optional<Hit>>> hits(columns);
      tbb::parallel_for(std::size_t{ 0 }, columns,
        [&](std::size_t x)
        {
          if (const auto& place = this->Places[row * columns + x])
          {
            hits[x] = this->Geometry.Gather(*place, this->RaysOfHalf(), Hash(seed, row, x));
          }
        });
      for (const auto& hitsOfPixel : hits)
      {
        for (const auto& hit : hitsOfPixel)
        {
          targets.push_back(map.Visit(hit));
        }
      }
    }
    return targets;
  }

  Image RenderHalf(std::uint64_t seed, const ReferenceProgress& progress) const
  {
    LightMap map(this->Geometry, this->Settings.mapCells, this->Settings.mapRays, Hash(seed, 1));
    const std::vector<std::uint32_t> targets =
      this->TargetsOfPixels(map, Hash(seed, 2), [&](double part) { progress(0.5 * part); });
    map.Solve([&](double part) { progress(0.5 + 0.5 * part); });
    Image image(this->Columns, this->Rows);
    image.pixels = this->Direct;
    auto next = targets.begin();
    for (std::size_t p = 0; p < this->Places.size(); ++p)
    {
      if (this->Places[p])
      {
        Color sum(0.0);
        for (int i = 0; i < this->RaysOfHalf(); ++i, ++next)
        {
          sum += *next != LightMap::Nowhere ? map.Reflected(*next) : Color(0.0);
        }
        image.pixels[p] += this->Places[p]->albedo * (sum / double(this->RaysOfHalf()));
      }
    }
    return image;
  }

  ReferenceSettings Settings;
  ReferenceGeometry Geometry;
  int Columns, Rows;                               ///< of the pixels that are taken
  std::vector<std::optional<SurfacePlace>> Places; ///< what the pixels see
  std::vector<Color> Direct;                       ///< radiance without indirect light
};

/// A hash of numbers, bit by bit.
class Key
{
public:
  void Add(std::uint64_t number) { this->State = Hash(this->State, number); }
  void Add(double number)
  {
    std::uint64_t bits = 0;
    static_assert(sizeof bits == sizeof number);
    std::memcpy(&bits, &number, sizeof bits);
    this->Add(bits);
  }
  void Add(const Vec3& v)
  {
    this->Add(v.x);
    this->Add(v.y);
    this->Add(v.z);
  }
  void Add(const std::vector<std::uint32_t>& list)
  {
    this->Add(static_cast<std::uint64_t>(list.size()));
    for (const std::uint32_t number : list)
    {
      this->Add(static_cast<std::uint64_t>(number));
    }
  }
  std::uint64_t Value() const { return this->State; }

private:
  std::uint64_t State = Recipe;
};

} // namespace

ReferenceImage ReferenceHalves::Joined() const
{
  ReferenceImage reference{ this->halves[0], 0.0 };
  for (std::size_t p = 0; p < reference.image.pixels.size(); ++p)
  {
    reference.image.pixels[p] = 0.5 * (this->halves[0].pixels[p] + this->halves[1].pixels[p]);
  }
  // Half their difference is distributed as the error of their mean is.
  reference.noise = 0.5 * Compare(this->halves[0], this->halves[1]).relativeL1;
  return reference;
}

int ReferenceWidth(const Camera& camera, const ReferenceSettings& settings)
{
  return std::max(1, static_cast<int>(std::lround(settings.size * camera.aspect)));
}

ReferenceHalves MakeReferenceHalves(const Scene& scene, const Camera& camera,
  const ReferenceSettings& givenSettings, const ReferenceProgress& givenProgress)
{
  constexpr int MoreRounds = 2;
  const ReferenceProgress progress = givenProgress ? givenProgress : [](double) {};
  PixelGather pixels(scene, camera, givenSettings);
  ReferenceHalves images = pixels.Render(progress);
  for (int round = 0; round < MoreRounds && images.Joined().noise > givenSettings.noise; ++round)
  {
    pixels.Refine(4);
    images = pixels.Render(progress);
  }
  return images;
}

ReferenceImage MakeReference(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
{
  return MakeReferenceHalves(scene, camera, settings).Joined();
}

Image EveryPixel(const Image& whole, int stride)
{
  Image image(EveryAlong(whole.width, stride), EveryAlong(whole.height, stride));
  for (int y = 0; y < image.height; ++y)
  {
    for (int x = 0; x < image.width; ++x)
    {
      image.At(x, y) = whole.At(stride / 2 + x * stride, stride / 2 + y * stride);
    }
  }
  return image;
}

std::uint64_t ReferenceKey(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
{
  Key key;
  for (const Vec3& v : scene.vertices)
  {
    key.Add(v);
  }
  key.Add(scene.indices);
  key.Add(scene.offsets);
  key.Add(scene.materialOfPolygon);
  for (const Material& material : scene.materials)
  {
    key.Add(material.albedo);
    key.Add(material.emission);
    key.Add(static_cast<std::uint64_t>(material.twoSided));
  }
  key.Add(camera.eye);
  key.Add(camera.lookAt);
  key.Add(camera.up);
  key.Add(camera.fieldOfView);
  key.Add(camera.aspect);
  key.Add(static_cast<std::uint64_t>(settings.size));
  key.Add(static_cast<std::uint64_t>(settings.stride));
  key.Add(static_cast<std::uint64_t>(settings.gatherRays));
  key.Add(static_cast<std::uint64_t>(settings.mapCells));
  key.Add(static_cast<std::uint64_t>(settings.mapRays));
  key.Add(settings.noise);
  if (ReferenceWidth(camera, settings) != settings.size)
  {
    key.Add(static_cast<std::uint64_t>(ReferenceWidth(camera, settings)));
  }
  return key.Value();
}

} // namespace vantage
