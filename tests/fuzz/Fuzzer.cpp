#include "fuzz/Target.h"

#include <cstddef>
#include <cstdint>

/// What libFuzzer calls. An exception that escapes counts as a crash.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  vantage::fuzz::ReadBytes(std::string(data, data + size));
  return 0;
}
