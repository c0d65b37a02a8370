#pragma once

#include <chrono>
#include <string>

/// \file ProgressBar.h
/// How far the work is, for someone who watches.

namespace vantage
{

/// One line on standard error that is drawn over and over: only on a terminal, and only once the
/// work has taken a second. It is wiped at the end of its life.
class ProgressBar
{
public:
  explicit ProgressBar(bool isWanted);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// \param fraction done, 0 .. 1. Cheap: draws ten times a second at most.
  void Update(double fraction, const std::string& text);

private:
  using Clock = std::chrono::steady_clock;

  bool IsWanted;
  bool IsDrawn = false;
  Clock::time_point NextTime;
};

} // namespace vantage
