#pragma once

#include <exception>
#include <thread>

/// \file parallel_invoke.h
/// Stand-in for oneTBB's function of two arguments; parallel_for.h says why.

namespace tbb
{

template <typename First, typename Second>
void parallel_invoke(const First& first, const Second& second)
{
  std::exception_ptr failure;
  std::thread thread(
    [&]()
    {
      try
      {
        first();
      }
      catch (...)
      {
        failure = std::current_exception();
      }
    });
  try
  {
    second();
  }
  catch (...)
  {
    thread.join();
    throw;
  }
  thread.join();
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

} // namespace tbb
