#include "Measure.h"

#include "core/Error.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <limits>

namespace vantage::benchmarks
{

namespace
{

double SecondsOf(clockid_t clock)
{
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

double CpuSeconds()
{
  return SecondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

double WallSeconds()
{
  return SecondsOf(CLOCK_MONOTONIC);
}

std::size_t PeakMemoryBytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

double Median(std::vector<double> values)
{
  for (double& value : values)
  {
    value = std::isnan(value) ? std::numeric_limits<double>::infinity() : value; // never over never
  }
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

void InOwnProcess(const std::function<void()>& work)
{
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0)
  {
    int code = 0;
    try
    {
      work();
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      code = 1;
    }
    std::fflush(nullptr);
    _exit(code); // the parent's destructors are the parent's
  }
  int status = 1;
  if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0)
  {
    throw Error("benchmark: a measurement in a process of its own failed");
  }
}

} // namespace vantage::benchmarks
