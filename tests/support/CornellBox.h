#pragma once

#include "core/scene/Scene.h"

/// \file CornellBox.h
/// The Cornell box as measured.

namespace vantage::test
{

/// Geometry and camera in millimetres, y up, from the measured data that the Cornell University
/// Program of Computer Graphics publishes (graphics.cornell.edu/online/box/data.html). Reflectances
/// and emission in RGB are the customary ones made of the published spectra (McGuire, Computer
/// Graphics Archive, 2017, "Cornell Box Original"; emission 17, 12, 4 W m^-2 sr^-1). As the page
/// says, the lamp sits in a hole of the ceiling. The left wall as measured is not flat: here it is
/// two triangles. The front is open. Camera: `front`.
Scene MakeCornellBox();

} // namespace vantage::test
