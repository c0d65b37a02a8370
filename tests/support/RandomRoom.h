#pragma once

#include "core/scene/Scene.h"

#include <cstdint>

/// \file RandomRoom.h
/// As many different small scenes as one likes.

namespace vantage::test
{

/// A room of 3 to 7 m, in one case of four without a ceiling and in another one without one of its
/// walls; up to four pieces of furniture that stand clear of each other (blocks turned any way, and
/// tables), up to two panels that hang at a slant, one to five lamps of 5 cm to 1.2 m under the
/// ceiling, on the walls or hanging free and turned any way, their radiances two decades apart;
/// albedos between 0.05 and 0.85. The camera `inside` stands in a corner that is kept free.
Scene MakeRandomRoom(std::uint64_t seed);

} // namespace vantage::test
