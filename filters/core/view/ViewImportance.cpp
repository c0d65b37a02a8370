#include "core/view/ViewImportance.h"

#include "core/math/Sampling.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Cells of the image plane, as square as whole numbers allow.
struct ImageGrid
{
  std::uint32_t columns, rows;

  ImageGrid(std::uint32_t cells, double aspect)
    : rows(static_cast<std::uint32_t>(
        std::clamp(std::round(std::sqrt(cells / aspect)), 1.0, static_cast<double>(cells))))
  {
    this->columns = std::max(1u, cells / this->rows);
  }
};

void SampleRow(const OccluderScene& occluders, const ElementTree& tree, const ImagePlane& plane,
  const ImageGrid& grid, std::uint32_t row, std::uint64_t seed, std::vector<ViewSample>& samples)
{
  const double cellArea = plane.Area() / (static_cast<double>(grid.columns) * grid.rows);
  for (std::uint32_t column = 0; column < grid.columns; ++column)
  {
    const Vec2 jitter = RandomStream(seed, row, column).Next2();
    const double s = 2.0 * (column + jitter.x) / grid.columns - 1.0;
    const double t = 2.0 * (row + jitter.y) / grid.rows - 1.0;
    const Vec3 direction = plane.Direction(s, t);
    const auto hit = occluders.Intersect(plane.eye, direction);
    if (hit && tree.Patches()[hit->Patch()].IsActive())
    {
      // A direction of depth 1 has the length 1 / cos_eye; cos_eye d omega = cos_eye^4 dA.
      const double squaredLength = glm::dot(direction, direction);
      samples.push_back({ hit->Patch(), hit->point, cellArea / (squaredLength * squaredLength) });
    }
  }
}

} // namespace

std::vector<ViewSample> SampleView(const OccluderScene& occluders, const ElementTree& tree,
  const Camera& camera, std::uint32_t rays, std::uint64_t seed)
{
  const ImagePlane plane(camera);
  const ImageGrid grid(rays, camera.aspect);
  std::vector<std::vector<ViewSample>> samplesOfRow(grid.rows);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, grid.rows),
    [&](const tbb::blocked_range<std::uint32_t>& rows)
    {
      for (std::uint32_t row = rows.begin(); row < rows.end(); ++row)
      {
        SampleRow(occluders, tree, plane, grid, row, seed, samplesOfRow[row]);
      }
    });
  std::vector<ViewSample> samples;
  samples.reserve(static_cast<std::size_t>(grid.columns) * grid.rows);
  for (const auto& row : samplesOfRow)
  {
    samples.insert(samples.end(), row.begin(), row.end());
  }
  return samples;
}

} // namespace vantage
