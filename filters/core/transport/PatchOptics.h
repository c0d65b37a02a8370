#pragma once

#include "core/math/Types.h"

/// \file PatchOptics.h
/// Materials as the transport sees them.

namespace vantage
{

/// What a side of a facet is made of.
struct PatchOptics
{
  Color albedo{ 0.0 };
  Color emission{ 0.0 }; ///< W m^-2 sr^-1
};

} // namespace vantage
