#pragma once

#include "core/Solver.h"

#include <optional>
#include <string>
#include <vector>

/// \file RenderReport.h
/// The figures of a run, as report.json and history.csv.

namespace vantage
{

/// One camera of a run.
struct FrameReport
{
  std::string camera;
  double viewFlux = 0.0; ///< these two as in RenderReport
  double errorEstimate = 0.0;
  std::size_t historyRows = 0;   ///< of this and all frames before
  std::uint64_t steps = 0;       ///< these of this frame alone
  std::uint64_t evaluations = 0; ///< pairs
  std::uint64_t solverRays = 0;
  GatherReport gather; ///< where the image is gathered
  double solveSeconds = 0.0;
  double imageSeconds = 0.0;
};

struct RenderReport
{
  std::string method;
  double viewFlux = 0.0;      ///< of the last frame, W m^-2, mean of channels
  double errorEstimate = 0.0; ///< of the last frame: StepReport::errorEstimate, with that of the
                              ///< gather where the image is gathered; of path tracing, noise
  std::optional<double> exposure; ///< of the .png images, as --exposure; none without images
  std::size_t elements = 0;
  std::size_t interactions = 0;
  std::uint64_t rays = 0;          ///< all of them
  WorkCounters work;               ///< of the solver
  std::uint64_t steps = 0;         ///< of path tracing, samples per pixel
  std::vector<FrameReport> frames; ///< none of path tracing
  double loadSeconds = 0.0;
  double buildSeconds = 0.0;
  double solveSeconds = 0.0;
  double imageSeconds = 0.0;
  double totalSeconds = 0.0;
  int threads = 0;
};

/// JSON; adds the peak memory of the process.
std::string PrintReport(const RenderReport& report);

/// A header, then a row a step, which starts with its frame, from 1.
std::string PrintHistory(
  const std::vector<StepReport>& history, const std::vector<FrameReport>& frames);

/// Light through the image per unit area of the eye, W m^-2: the integral of L cos over the image's
/// solid angle, cos taken against the line of sight; mean of channels.
double ViewFluxOf(const Image& image, const Camera& camera);

} // namespace vantage
