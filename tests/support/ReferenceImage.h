#pragma once

#include "core/math/Image.h"
#include "core/scene/Scene.h"

#include <cstdint>
#include <string>

/// \file ReferenceImage.h
/// Pictures to judge others by.

namespace vantage::test
{

/// How a reference is made. It consists of two halves that are independent in all that is random.
struct ReferenceSettings
{
  int size = 48;         ///< pixels along each side of the picture
  int stride = 1;        ///< only every so many-th pixel of a row, and every so many-th row
  int gatherRays = 8192; ///< a pixel, shared by the halves; best twice a power of two
  int mapCells = 64000;  ///< that would cover the scene, in each half
  int mapRays = 64;      ///< of each of them; best a power of two
  double noise = 0.003;  ///< when it turns out larger, all rays are made four times as many, twice
};

/// Radiance at the centres of the pixels: size / stride along each side.
struct ReferenceImage
{
  Image image;
  double noise = 0.0; ///< relative L1 error to be expected, from the difference of the halves
};

/// Direct light exactly, past all occluders (ExactDirectLight.h); indirect light by a gather into a
/// light map (LightMap.h). Owes nothing to transport/. Parallel; the same for any number of
/// threads.
ReferenceImage MakeReference(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings = {});

/// The same, from a folder of OpenEXR files when it is there; else it is made and stored. The name
/// is for people, the key is the scene, the camera and the settings to the bit.
ReferenceImage CachedReference(const std::string& folder, const std::string& name,
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings = {});

/// The pixels of a whole picture that a reference with this stride has.
Image EveryPixel(const Image& whole, int stride);

/// A hash of all numbers that a reference depends on.
std::uint64_t ReferenceKey(
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings);

/// A path-traced image that owes nothing to the solver, and the standard error of its mean,
/// relative.
struct TracedImage
{
  Image image;
  double noiseOfMean = 0.0;
};
TracedImage PathTraced(const Scene& scene, const Camera& camera, int size, int samplesPerPixel,
  bool pixelCentres = false);

} // namespace vantage::test
