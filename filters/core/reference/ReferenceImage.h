#pragma once

#include "core/math/Image.h"
#include "core/scene/Scene.h"

#include <array>
#include <cstdint>
#include <functional>

/// \file ReferenceImage.h
/// Pictures to judge others by.

namespace vantage
{

/// How a reference is made. It consists of two halves that are independent in all that is random.
struct ReferenceSettings
{
  int size = 48;         ///< rows of pixels; a row has as many as make them square
  int stride = 1;        ///< only every so many-th pixel of a row, and every so many-th row
  int gatherRays = 8192; ///< a pixel, shared by the halves; best twice a power of two
  int mapCells = 64000;  ///< that would cover the scene, in each half
  int mapRays = 64;      ///< of each of them; best a power of two
  double noise = 0.003;  ///< when it turns out larger, rays of the pixels and cells are made four
                         ///< times as many, twice at most
};

/// Radiance at the centres of the pixels, of every stride-th one each way.
struct ReferenceImage
{
  Image image;
  double noise = 0.0; ///< relative L1 error to be expected, from the difference of the halves
};

/// Two estimates of the same picture that are independent in all that is random.
struct ReferenceHalves
{
  std::array<Image, 2> halves;

  /// Their mean.
  ReferenceImage Joined() const;
};

/// Called from the calling thread with the part done, 0 .. 1; from 0 again where the noise asks for
/// more. What it throws ends the work.
using ReferenceProgress = std::function<void(double)>;

/// Direct light exactly, past all occluders (ExactDirectLight.h); indirect light by a gather into a
/// light map (LightMap.h). Owes nothing to transport/. Parallel; the same for any number of
/// threads. \pre valid scene and camera
ReferenceHalves MakeReferenceHalves(const Scene& scene, const Camera& camera,
  const ReferenceSettings& settings = {}, const ReferenceProgress& progress = {});
ReferenceImage MakeReference(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings = {});

/// Pixels of a row of the whole picture.
int ReferenceWidth(const Camera& camera, const ReferenceSettings& settings);

/// The pixels of a whole picture that a reference with this stride has.
Image EveryPixel(const Image& whole, int stride);

/// A hash of all numbers that a reference depends on.
std::uint64_t ReferenceKey(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings);

} // namespace vantage
