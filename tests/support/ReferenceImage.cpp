#include "support/ReferenceImage.h"

#include "core/math/Sampling.h"
#include "core/reference/PathTracer.h"
#include "io/ExrFile.h"
#include "support/LightMap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

namespace vantage::test
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

/// Two independent estimates of the same picture.
struct HalfImages
{
  std::array<Image, Halves> halves;

  ReferenceImage Joined() const
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
};

/// What the pixel centres see.
class PixelGather
{
public:
  PixelGather(const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
    : Settings(settings)
    , Geometry(scene)
  {
    const ImagePlane plane(camera);
    const int size = settings.size;
    for (int y = settings.stride / 2; y < size; y += settings.stride)
    {
      for (int x = settings.stride / 2; x < size; x += settings.stride)
      {
        const Vec2 at = (Vec2(x, y) + 0.5) * (2.0 / size) - 1.0;
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

  HalfImages Render() const
  {
    HalfImages images;
    for (int half = 0; half < Halves; ++half)
    {
      images.halves[half] = this->RenderHalf(static_cast<std::uint64_t>(half));
    }
    return images;
  }

private:
  int PixelsAlong() const { return EveryAlong(this->Settings.size, this->Settings.stride); }
  int RaysOfHalf() const { return std::max(1, this->Settings.gatherRays / Halves); }

  /// Which points of the map the gather rays of each pixel that is a surface lead to.
  std::vector<std::uint32_t> TargetsOfPixels(LightMap& map, std::uint64_t seed) const
  {
    std::vector<std::uint32_t> targets;
    const auto size = static_cast<std::size_t>(this->PixelsAlong());
    for (std::size_t row = 0; row < size; ++row)
    {
      std::vector<std::vector<std::optional<Hit>>> hits(size);
      tbb::parallel_for(std::size_t{ 0 }, size,
        [&](std::size_t x)
        {
          if (const auto& place = this->Places[row * size + x])
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

  Image RenderHalf(std::uint64_t seed) const
  {
    LightMap map(this->Geometry, this->Settings.mapCells, this->Settings.mapRays, Hash(seed, 1));
    const std::vector<std::uint32_t> targets = this->TargetsOfPixels(map, Hash(seed, 2));
    map.Solve();
    Image image(this->PixelsAlong(), this->PixelsAlong());
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
  std::vector<std::optional<SurfacePlace>> Places; ///< what the pixels see
  std::vector<Color> Direct;                       ///< radiance without indirect light
};

HalfImages MakeHalves(const Scene& scene, const Camera& camera, ReferenceSettings settings)
{
  constexpr int MoreRounds = 2;
  HalfImages images = PixelGather(scene, camera, settings).Render();
  for (int round = 0; round < MoreRounds && images.Joined().noise > settings.noise; ++round)
  {
    settings.gatherRays *= 4;
    settings.mapRays *= 4;
    images = PixelGather(scene, camera, settings).Render();
  }
  return images;
}

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

double Total(const Image& image)
{
  double sum = 0.0;
  for (const Color& pixel : image.pixels)
  {
    sum += Mean(pixel);
  }
  return sum;
}

} // namespace

ReferenceImage MakeReference(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
{
  return MakeHalves(scene, camera, settings).Joined();
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
  return key.Value();
}

ReferenceImage CachedReference(const std::string& folder, const std::string& name,
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings)
{
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx",
    static_cast<unsigned long long>(ReferenceKey(scene, camera, settings)));
  const auto fileOf = [&](int half)
  {
    const std::string file = name + "-" + hash + (half == 0 ? "-a.exr" : "-b.exr");
    return (std::filesystem::path(folder) / file).string();
  };
  HalfImages images;
  if (std::filesystem::exists(fileOf(0)) && std::filesystem::exists(fileOf(1)))
  {
    images.halves = { ReadExr(fileOf(0)), ReadExr(fileOf(1)) };
    return images.Joined();
  }
  std::filesystem::create_directories(folder);
  images = MakeHalves(scene, camera, settings);
  for (int half = 0; half < Halves; ++half)
  {
    WriteExr(images.halves[half], fileOf(half));
  }
  return images.Joined();
}

TracedImage PathTraced(
  const Scene& scene, const Camera& camera, int size, int samplesPerPixel, bool pixelCentres)
{
  constexpr int Batches = 4;
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  const PathTracer tracer(scene, facets, occluders);
  PathTracerSettings settings;
  settings.samplesPerPixel = std::max(1, samplesPerPixel / Batches);
  settings.pixelCentres = pixelCentres;
  TracedImage result{ Image(size, size), 0.0 };
  double squares = 0.0;
  for (int batch = 0; batch < Batches; ++batch)
  {
    settings.seed = static_cast<std::uint64_t>(batch) + 1;
    const Image image = tracer.Render(camera, size, size, settings);
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
    {
      result.image.pixels[p] += image.pixels[p] / static_cast<double>(Batches);
    }
    squares += Total(image) * Total(image) / Batches;
  }
  const double mean = Total(result.image);
  const double variance = std::max(0.0, squares - mean * mean) / (Batches - 1);
  result.noiseOfMean = std::sqrt(variance) / mean;
  return result;
}

} // namespace vantage::test
