#pragma once

#include <cstddef>

/// \file blocked_range.h
/// Stand-in for oneTBB's class of that name; see parallel_for.h.

namespace tbb
{

template <typename Value>
class blocked_range
{
public:
  using const_iterator = Value;
  using size_type = std::size_t;

  blocked_range(Value begin, Value end, size_type grainSize = 1)
    : Begin(begin)
    , End(end)
    , GrainSize(grainSize)
  {
  }

  Value begin() const { return this->Begin; }
  Value end() const { return this->End; }
  size_type size() const { return static_cast<size_type>(this->End - this->Begin); }
  size_type grainsize() const { return this->GrainSize; }
  bool empty() const { return !(this->Begin < this->End); }

private:
  Value Begin;
  Value End;
  size_type GrainSize;
};

} // namespace tbb
