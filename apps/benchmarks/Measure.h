#pragma once

#include <cstddef>
#include <functional>
#include <vector>

/// \file Measure.h
/// What benchmarks measure with.

namespace vantage::benchmarks
{

/// Processor time of all threads of this process, s.
double CpuSeconds();
double WallSeconds();

/// The largest resident memory of this process so far, bytes.
std::size_t PeakMemoryBytes();

/// Processor and wall-clock time since it was made.
class Stopwatch
{
public:
  double Cpu() const { return CpuSeconds() - this->CpuStart; }
  double Wall() const { return WallSeconds() - this->WallStart; }

private:
  double CpuStart = CpuSeconds();
  double WallStart = WallSeconds();
};

/// Of an even number of values the mean of the middle two. \pre there is a value
double Median(std::vector<double> values);

/// Runs the work in a process of its own, so that its peak memory is not that of what ran before.
/// Must not be called when other threads are running. \throw Error when the work fails.
void InOwnProcess(const std::function<void()>& work);

} // namespace vantage::benchmarks
