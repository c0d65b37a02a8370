#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// \file Measurement.h
/// What one picture has cost and how far it is from the reference.

namespace vantage
{

/// Whose picture it is: how a solution was made visible.
namespace picture
{
inline const std::string Gathered = "gathered"; ///< Solver::Gather()
inline const std::string Elements = "elements"; ///< Solver::Render()
inline const std::string Traced = "traced";     ///< of the path tracer
} // namespace picture

struct Measurement
{
  std::string method;
  std::string picture;
  double powerTolerance = 0.0; ///< RefinementSettings::powerTolerance; 0 where there is none
  double budget = 0.0;         ///< asked error; of path tracing samples a pixel
  bool isCutShort = false;     ///< its time was up before
  std::uint64_t steps = 0;     ///< of the solver; of path tracing, samples a pixel that were taken
  std::size_t elements = 0;
  std::size_t interactions = 0;
  std::uint64_t evaluations = 0; ///< of pairs
  std::uint64_t rays = 0;        ///< of solution and picture
  double error = 0.0;            ///< against the reference, relative L1
  double rmse = 0.0;             ///< relative
  double bias = 0.0;             ///< relative, signed
  double errorEstimate = 0.0;    ///< what the method itself says
  double solveCpuSeconds = 0.0;  ///< processor time of all threads, from a built scene
  double imageCpuSeconds = 0.0;
  std::string image; ///< names of files: the picture and its difference to the reference
  std::string differenceImage;

  double CpuSeconds() const { return this->solveCpuSeconds + this->imageCpuSeconds; }
};

/// A header, then a row each. The columns of seconds are the last three.
std::string PrintMeasurements(const std::vector<Measurement>& measurements);

} // namespace vantage
