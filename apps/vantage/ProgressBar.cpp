#include "ProgressBar.h"

#include <algorithm>
#include <iostream>
#include <unistd.h>

namespace vantage
{

ProgressBar::ProgressBar(bool isWanted)
  : IsWanted(isWanted && isatty(STDERR_FILENO) != 0)
  , NextTime(Clock::now() + std::chrono::seconds(1))
{
}

ProgressBar::~ProgressBar()
{
  if (this->IsDrawn)
  {
    std::cerr << "\r\x1b[K" << std::flush; // back to the first column, clear the line
  }
}

void ProgressBar::Update(double fraction, const std::string& text)
{
  const Clock::time_point now = Clock::now();
  if (!this->IsWanted || now < this->NextTime)
  {
    return;
  }
  constexpr int Width = 30;
  const int done = static_cast<int>(Width * std::clamp(fraction, 0.0, 1.0));
  std::cerr << "\r\x1b[K[" << std::string(done, '#') << std::string(Width - done, ' ') << "] "
            << text << std::flush;
  this->IsDrawn = true;
  this->NextTime = now + std::chrono::milliseconds(100);
}

} // namespace vantage
