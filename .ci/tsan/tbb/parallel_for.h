#pragma once

#include <tbb/blocked_range.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

/// \file parallel_for.h
/// Stand-in for oneTBB's function, made of std::thread, for builds with the thread sanitizer.
/// The sanitizer cannot see how the library, which is not instrumented, hands work from thread to
/// thread, and reports each hand-over as a race. It sees through this one: what it still reports
/// is a race between the bodies of the loops.

namespace tbb
{

namespace detail
{
inline constexpr std::size_t ThreadCount = 4; // more than one even where there is one core
}

template <typename Value, typename Body>
void parallel_for(const blocked_range<Value>& range, const Body& body)
{
  const std::size_t chunk = std::max(range.grainsize(), range.size() / (8 * detail::ThreadCount));
  const std::size_t chunks = (range.size() + chunk - 1) / chunk;
  std::atomic<std::size_t> next{ 0 };
  std::exception_ptr failure;
  std::mutex failureMutex;

  // The counter is relaxed, so that taking a chunk does not order what the bodies do.
  const auto work = [&]()
  {
    try
    {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < chunks;)
      {
        const Value begin = range.begin() + static_cast<Value>(i * chunk);
        const Value end =
          range.begin() + static_cast<Value>(std::min(range.size(), (i + 1) * chunk));
        body(blocked_range<Value>(begin, end, range.grainsize()));
      }
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(failureMutex);
      failure = std::current_exception();
    }
  };

  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < std::min(detail::ThreadCount, chunks); ++i)
  {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

template <typename Index, typename Function>
void parallel_for(Index first, Index last, const Function& function)
{
  parallel_for(blocked_range<Index>(first, last),
    [&](const blocked_range<Index>& range)
    {
      for (Index i = range.begin(); i < range.end(); ++i)
      {
        function(i);
      }
    });
}

} // namespace tbb
