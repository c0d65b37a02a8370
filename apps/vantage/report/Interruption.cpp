#include "report/Interruption.h"

#include <csignal>
#include <initializer_list>

namespace vantage
{

namespace
{

volatile std::sig_atomic_t NotedSignal = 0;

extern "C" void NoteSignal(int signal)
{
  NotedSignal = signal;
}

void SetHandler(void (*handler)(int))
{
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : { SIGINT, SIGTERM })
  {
    sigaction(signal, &action, nullptr);
  }
}

} // namespace

InterruptionWatch::InterruptionWatch()
{
  NotedSignal = 0;
  SetHandler(NoteSignal);
}

InterruptionWatch::~InterruptionWatch()
{
  SetHandler(SIG_DFL);
}

void InterruptionWatch::Check() const
{
  if (NotedSignal != 0)
  {
    throw Interrupted();
  }
}

int InterruptionWatch::ExitCode() const
{
  return 128 + NotedSignal;
}

} // namespace vantage
