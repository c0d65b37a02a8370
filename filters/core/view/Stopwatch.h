#pragma once

#include <chrono>

/// \file Stopwatch.h
/// Seconds between two places of a function.

namespace vantage
{

class Stopwatch
{
public:
  /// Wall-clock seconds since the last call, or since it was made.
  double Lap()
  {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - this->Start).count();
    this->Start = now;
    return seconds;
  }

private:
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
};

} // namespace vantage
