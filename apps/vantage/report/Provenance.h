#pragma once

#include "core/math/Image.h"

#include <string>

/// \file Provenance.h
/// By whom and on what something was made, and which it is.

namespace vantage
{

/// 16 hexadecimal digits (FNV-1a).
std::string HashOfText(const std::string& text);
/// The same of all pixels, to the bit.
std::string HashOfImage(const Image& image);

/// "0.1.0, build 0123456789abcdef": the build is a hash of the running program itself.
std::string ProgramVersion();
/// "VTK 9.1.0, ...; compiler".
std::string LibraryVersions();
/// Processor, its number, memory, system; what cannot be found out is left out.
std::string MachineDescription();

} // namespace vantage
