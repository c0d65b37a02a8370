#pragma once

#include "core/mesh/Facets.h"

#include <string>
#include <vector>

/// \file SceneSummary.h
/// What a scene contains, in words.

namespace vantage
{

/// What had to be mended, and what is missing to see anything; one line each.
std::vector<std::string> SceneWarnings(const Scene& scene, const FacetSet& facets);

/// Several lines: counts, bounding box, emitters with their power, cameras.
std::string DescribeScene(const Scene& scene, const FacetSet& facets);

} // namespace vantage
