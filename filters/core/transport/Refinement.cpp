#include "core/transport/Refinement.h"

#include "core/Error.h"
#include "core/mesh/KernelVariation.h"
#include "core/mesh/LongestEdge.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Areas that differ by less, relatively, are the same but for the rounding of coordinates.
constexpr double SameSize = 1e-6;

void RequireRange(const std::string& name, double value, bool isInside, const std::string& range)
{
  if (!isInside)
  {
    throw InputError("refinement: " + name + " is " + std::to_string(value) + "; give " + range);
  }
}

} // namespace

void RefinementSettings::Validate() const
{
  RequireRange("formFactorTolerance", this->formFactorTolerance,
    this->formFactorTolerance > 0.0 && this->formFactorTolerance <= 1.0, "a number in (0, 1]");
  RequireRange("powerTolerance", this->powerTolerance,
    this->powerTolerance >= 0.0 && std::isfinite(this->powerTolerance), "a number >= 0");
  RequireRange("shadowTolerance", this->shadowTolerance,
    this->shadowTolerance >= 0.0 && std::isfinite(this->shadowTolerance), "a number >= 0");
  RequireRange("minimumElementSize", this->minimumElementSize,
    this->minimumElementSize > 0.0 && std::isfinite(this->minimumElementSize), "a number > 0");
  RequireRange("maximumLevel", this->maximumLevel,
    this->maximumLevel >= 0 && this->maximumLevel <= 20, "an integer from 0 to 20");
}

std::string NameOf(RefinementOracle oracle)
{
  return oracle == RefinementOracle::F ? "F" : "BF";
}

RefinementOracle RefinementOracleFromName(const std::string& name)
{
  if (name == "F")
  {
    return RefinementOracle::F;
  }
  if (name == "BF")
  {
    return RefinementOracle::BF;
  }
  throw UnknownNameError("refinement oracle", name, "F, BF");
}

Refiner::Refiner(const RefinementSettings& settings, double meanFacetArea)
  : Settings(settings)
  , MinimumLength(settings.minimumElementSize * std::sqrt(meanFacetArea))
{
}

SplitChoice Refiner::Choose(const ElementTree& tree, const RefinementQuery& query) const
{
  if (!this->IsTooCoarse(tree, query))
  {
    return {};
  }
  const Node& first = tree[query.first];
  const Node& second = tree[query.second];
  const SplitChoice may{ this->MaySplit(first), this->MaySplit(second) };
  if (!may.first || !may.second || std::abs(first.area - second.area) <= SameSize * first.area)
  {
    return may;
  }
  return { first.area > second.area, second.area > first.area };
}

bool Refiner::IsTooCoarse(const ElementTree& tree, const RefinementQuery& query) const
{
  const double smallerArea = std::min(tree[query.first].area, tree[query.second].area);
  // Of the whole larger end, seen or not: the kernel varies over it all the same.
  const double formFactor = query.throughput / (query.visibility * Pi * smallerArea);
  const bool isLarge = formFactor > this->Settings.formFactorTolerance;
  if (this->Settings.oracle == RefinementOracle::F)
  {
    return isLarge;
  }
  if (query.visibility < 1.0)
  {
    return query.relativePower >
           (query.isDirect ? this->Settings.shadowTolerance : this->Settings.powerTolerance);
  }
  return query.relativePower * KernelVariation(tree[query.first], tree[query.second]) >
         this->Settings.powerTolerance;
}

bool Refiner::MaySplit(const Node& node) const
{
  // A node that has children costs nothing to split again.
  return !node.IsLeaf() || (node.level < this->Settings.maximumLevel &&
                             0.5 * LongestEdge(node) >= this->MinimumLength);
}

} // namespace vantage
