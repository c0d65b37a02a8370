#pragma once

#include <exception>

/// \file Interruption.h
/// To be asked to stop, and to stop where it does no harm.

namespace vantage
{

/// Thrown by those who stop because they were asked to.
struct Interrupted : std::exception
{
  const char* what() const noexcept override { return "interrupted"; }
};

/// While it lives, the first SIGINT or SIGTERM is only noted; a second one ends the process as
/// usual. One at a time.
class InterruptionWatch
{
public:
  InterruptionWatch();
  ~InterruptionWatch();
  InterruptionWatch(const InterruptionWatch&) = delete;
  InterruptionWatch& operator=(const InterruptionWatch&) = delete;

  /// \throw Interrupted when a signal was noted.
  void Check() const;
  /// 128 and the number of the signal, as shells have it. \pre there was one
  int ExitCode() const;
};

} // namespace vantage
