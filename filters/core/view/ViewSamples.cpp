#include "core/view/ViewSamples.h"

#include "core/math/Sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace vantage
{

namespace
{

constexpr int BlockSize = 32;

/// Samples the pixels of one block.
class BlockSampler
{
public:
  BlockSampler(const ImagePlane& plane, int width, ViewSamples& image)
    : Eye(&plane)
    , Width(width)
    , Image(&image)
  {
  }

  void Sample(const ScreenTile& tile, bool pixelCentres)
  {
    const ScreenTile::Rectangle& r = tile.Pixels();
    for (int y = r.y; y < r.y + r.height; ++y)
    {
      for (int x = r.x; x < r.x + r.width; ++x)
      {
        this->SamplePixel(tile, x, y, pixelCentres);
      }
    }
  }

  std::vector<GatherPoint> points;
  std::vector<std::uint32_t> pixelOfPoint;
  std::uint64_t rays = 0;
  std::uint64_t looks = 0;

private:
  /// A part of a pixel, and what it sees.
  struct Part
  {
    PatchId patch;
    Vec3 point;
  };

  void SamplePixel(const ScreenTile& tile, int x, int y, bool pixelCentres)
  {
    const std::uint32_t pixel = static_cast<std::uint32_t>(y) * this->Width + x;
    const Vec2 centre = tile.Place(x + 0.5, y + 0.5);
    const EyeHit hit = tile.Look(centre, this->rays);
    ++this->looks;
    const Vec3 direction = this->Eye->Direction(centre.x, centre.y);
    this->Image->centres[pixel] = hit;
    if (!pixelCentres && (hit.patch == None || !tile.SeesOnly(x, y, hit.patch)))
    {
      this->SampleParts(tile, x, y, pixel);
    }
    else if (hit.patch != None)
    {
      this->AddPoint(pixel, hit.patch, this->Eye->eye + hit.depth * direction, 1.0);
    }
  }

  void SampleParts(const ScreenTile& tile, int x, int y, std::uint32_t pixel)
  {
    this->Parts.clear();
    for (std::uint32_t i = 0; i < PartsOfPixel; ++i)
    {
      const Vec2 offset = PlaceOfPart(i);
      const Vec2 place = tile.Place(x + offset.x, y + offset.y);
      const EyeHit hit = tile.Look(place, this->rays);
      if (hit.patch != None)
      {
        this->Parts.push_back(
          { hit.patch, this->Eye->eye + hit.depth * this->Eye->Direction(place.x, place.y) });
      }
    }
    this->looks += PartsOfPixel;
    std::stable_sort(this->Parts.begin(), this->Parts.end(),
      [](const Part& a, const Part& b) { return a.patch < b.patch; });
    for (auto first = this->Parts.begin(); first != this->Parts.end();)
    {
      const auto last = std::find_if(
        first, this->Parts.end(), [&](const Part& part) { return part.patch != first->patch; });
      const double weight = static_cast<double>(last - first) / PartsOfPixel;
      this->AddPoint(pixel, first->patch, MiddleOf(&*first, &*first + (last - first)), weight);
      first = last;
    }
  }

  void AddPoint(std::uint32_t pixel, PatchId patch, const Vec3& point, double weight)
  {
    this->points.push_back({ patch, point, weight });
    this->pixelOfPoint.push_back(pixel);
  }

  /// The point nearest to the mean of all: the mean itself may be hidden.
  static Vec3 MiddleOf(const Part* first, const Part* last)
  {
    Vec3 mean(0.0);
    for (const Part* part = first; part != last; ++part)
    {
      mean += part->point / static_cast<double>(last - first);
    }
    const auto distance = [&](const Part& part)
    { return glm::dot(part.point - mean, part.point - mean); };
    return std::min_element(
      first, last, [&](const Part& a, const Part& b) { return distance(a) < distance(b); })
      ->point;
  }

  const ImagePlane* Eye;
  int Width;
  ViewSamples* Image;
  std::vector<Part> Parts;
};

} // namespace

/// Hammersley's points.
Vec2 PlaceOfPart(std::uint32_t part)
{
  return { (part + 0.5) / PartsOfPixel, RadicalInverse2(part) + 0.5 / PartsOfPixel };
}

ViewSamples SampleImage(
  const OccluderScene& occluders, const ImagePlane& plane, int width, int height, bool pixelCentres)
{
  ViewSamples image;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  image.centres.resize(pixels);
  const Vec2 pixelSize(2.0 / width, 2.0 / height);
  const int columns = (width + BlockSize - 1) / BlockSize;
  const int rows = (height + BlockSize - 1) / BlockSize;
  std::vector<BlockSampler> blocks(columns * rows, BlockSampler(plane, width, image));
  tbb::parallel_for(0, columns * rows,
    [&](int b)
    {
      const int x = b % columns * BlockSize;
      const int y = b / columns * BlockSize;
      const ScreenTile::Rectangle block{ x, y, std::min(BlockSize, width - x),
        std::min(BlockSize, height - y) };
      for (const ScreenTile& tile : ScreenTile::Cut(occluders, plane, pixelSize, block))
      {
        blocks[b].Sample(tile, pixelCentres);
      }
    });
  for (const BlockSampler& block : blocks)
  {
    image.points.insert(image.points.end(), block.points.begin(), block.points.end());
    image.pixelOfPoint.insert(
      image.pixelOfPoint.end(), block.pixelOfPoint.begin(), block.pixelOfPoint.end());
    image.rays += block.rays;
    image.looks += block.looks;
  }
  return image;
}

} // namespace vantage
