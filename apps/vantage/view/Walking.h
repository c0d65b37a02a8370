#pragma once

#include "core/scene/Camera.h"

/// \file Walking.h
/// How a camera moves that somebody carries.

namespace vantage
{

/// Looks elsewhere from the same place: to the right, and up, by so many radians. Up stays up, and
/// the gaze stays 5 degrees away from it.
Camera Turned(const Camera& camera, double toRight, double upward);

/// Goes forward where it looks, or to the right, or up, in scene units.
Camera Moved(const Camera& camera, double forward, double toRight, double upward);

} // namespace vantage
