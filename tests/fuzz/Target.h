#pragma once

#include "core/Error.h"
#include "core/scene/Scene.h"

#include <functional>
#include <stdexcept>
#include <string>

/// \file Target.h
/// What a reader of files is held to, whatever the bytes. Each target is a file that defines
/// ReadBytes(); it runs over the corpus as a test, and under libFuzzer (VANTAGE_FUZZ).

namespace vantage::fuzz
{

/// Takes the bytes for a file of the target's format. Returns when they are read, or refused with
/// an InputError of one line; anything else escapes as an exception, or ends the process.
void ReadBytes(const std::string& bytes);

/// \throw std::logic_error, for a promise of the reader that is broken.
inline void Require(bool promise, const std::string& what)
{
  if (!promise)
  {
    throw std::logic_error(what);
  }
}

/// Whether `read` was able to read. What it may throw is an InputError that fits a line.
bool IsRead(const std::function<void()>& read);

/// Promises that the two are equal to the bit, cameras and materials included.
void RequireSame(const Scene& a, const Scene& b);

} // namespace vantage::fuzz
