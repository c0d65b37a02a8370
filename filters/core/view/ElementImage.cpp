#include "core/view/ElementImage.h"

#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/math/ScrambledSobol.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <string>

namespace vantage
{

namespace
{

/// Below this, 1 + cos of the angle under which an edge is seen says that the point lies on it.
constexpr double OnEdge = 1e-12;

void RequireAtLeastOne(int value, const char* name)
{
  if (value < 1)
  {
    throw InputError(
      std::string(name) + " is " + std::to_string(value) + "; give a number of at least 1");
  }
}

/// Mean value interpolation on a convex polygon (Floater 2003), which may have corners in the
/// middle of straight sides. Corner i has the position point(i) and the value value(i).
template <typename PointOf, typename ValueOf>
Color MeanValue(
  int corners, const PointOf& point, const ValueOf& value, const Vec3& normal, const Vec3& x)
{
  Color sum(0.0);
  double total = 0.0;
  for (int i = 0; i < corners; ++i)
  {
    const int next = i + 1 < corners ? i + 1 : 0;
    const Vec3 a = point(i) - x;
    const Vec3 b = point(next) - x;
    const double lengthA = glm::length(a);
    const double lengthB = glm::length(b);
    const double onePlusCosine = lengthA * lengthB + glm::dot(a, b);
    if (onePlusCosine <= OnEdge * lengthA * lengthB)
    {
      const double t = lengthA + lengthB > 0.0 ? lengthA / (lengthA + lengthB) : 0.0;
      return (1.0 - t) * value(i) + t * value(next);
    }
    const double tangentOfHalf = glm::dot(glm::cross(a, b), normal) / onePlusCosine;
    sum += tangentOfHalf * (value(i) / lengthA + value(next) / lengthB);
    total += tangentOfHalf * (1.0 / lengthA + 1.0 / lengthB);
  }
  return sum / total;
}

} // namespace

void ElementImageSettings::Validate() const
{
  RequireAtLeastOne(this->width, "image width");
  RequireAtLeastOne(this->height, "image height");
  RequireAtLeastOne(this->samplesPerPixel, "samples per pixel");
}

SurfaceInterpolator::SurfaceInterpolator(const ElementTree& tree, const ElementSurface& surface)
  : Tree(&tree)
  , Surface(&surface)
  , PolygonOfNode(tree.Size(), None)
{
  for (std::uint32_t p = 0; p < surface.PolygonCount(); ++p)
  {
    this->PolygonOfNode[surface.elements[p]] = p;
  }
}

std::uint32_t SurfaceInterpolator::PolygonAt(PatchId patch, const Vec3& point) const
{
  const Patch& side = this->Tree->Patches()[patch];
  return side.IsActive() ? this->PolygonOfNode[this->Tree->LeafContaining(side.node, point)] : None;
}

Color SurfaceInterpolator::At(
  const std::vector<Color>& valueOfPoint, PatchId patch, const Vec3& point) const
{
  const std::uint32_t polygon = this->PolygonAt(patch, point);
  if (polygon == None)
  {
    return Color(0.0);
  }
  const std::uint32_t first = this->Surface->offsets[polygon];
  const int corners = static_cast<int>(this->Surface->offsets[polygon + 1] - first);
  const auto pointId = [&](int i) { return this->Surface->indices[first + i]; };
  return MeanValue(
    corners, [&](int i) { return this->Surface->points[pointId(i)]; },
    [&](int i) { return valueOfPoint[pointId(i)]; }, this->Tree->Patches()[patch].normal, point);
}

Image RenderElements(const OccluderScene& occluders, const ElementTree& tree,
  const ElementSurface& surface, const std::vector<Color>& radiance, const Camera& camera,
  const ElementImageSettings& settings)
{
  settings.Validate();
  const SurfaceInterpolator interpolator(tree, surface);
  const auto radianceAt = [&](const Hit& hit)
  {
    if (!settings.flat)
    {
      return interpolator.At(radiance, hit.Patch(), hit.point);
    }
    const std::uint32_t polygon = interpolator.PolygonAt(hit.Patch(), hit.point);
    return polygon == None ? Color(0.0) : radiance[polygon];
  };
  const ImagePlane plane(camera);
  const int samples = settings.pixelCentres ? 1 : settings.samplesPerPixel;
  Image image(settings.width, settings.height);
  const auto renderPixel = [&](int x, int y)
  {
    Color sum(0.0);
    for (int i = 0; i < samples; ++i)
    {
      const Vec2 place =
        settings.pixelCentres ? Vec2(0.5) : ScrambledSobol(i, Hash(settings.seed, x, y));
      const Vec3 direction = plane.Direction(
        2.0 * (x + place.x) / settings.width - 1.0, 2.0 * (y + place.y) / settings.height - 1.0);
      if (const auto hit = occluders.Intersect(plane.eye, direction))
      {
        sum += radianceAt(*hit);
      }
    }
    image.At(x, y) = sum / static_cast<double>(samples);
  };
  tbb::parallel_for(0, settings.height,
    [&](int y)
    {
      for (int x = 0; x < settings.width; ++x)
      {
        renderPixel(x, y);
      }
    });
  return image;
}

} // namespace vantage
