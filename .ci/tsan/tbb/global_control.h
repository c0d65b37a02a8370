#pragma once

#include <cstddef>

/// \file global_control.h
/// Stand-in for oneTBB's class of that name; see parallel_for.h. It limits nothing.

namespace tbb
{

class global_control
{
public:
  enum parameter
  {
    max_allowed_parallelism
  };

  global_control(parameter, std::size_t) {}
};

} // namespace tbb
