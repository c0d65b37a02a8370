#pragma once

/// \file task_arena.h
/// Stand-in for oneTBB's class of that name; see parallel_for.h. It limits nothing: the sanitizer
/// wants several threads always.

namespace tbb
{

class task_arena
{
public:
  explicit task_arena(int /*concurrency*/ = -1) {}

  template <typename Function>
  auto execute(const Function& function)
  {
    return function();
  }
};

} // namespace tbb
