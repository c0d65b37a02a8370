#include "properties/Found.h"

#include "properties/RandomScene.h"

namespace vantage::test
{

Found FoundBy(const Solver& solver)
{
  const ElementSolution elements = solver.Elements();
  Found found;
  found.radiance = MeansOverPolygonSides(solver, elements, elements.radiance);
  found.importance = MeansOverPolygonSides(solver, elements, elements.importance);
  for (const StepReport& report : solver.History())
  {
    found.history.insert(found.history.end(),
      { report.viewFlux, report.errorEstimate, static_cast<double>(report.elements),
        static_cast<double>(report.interactions), static_cast<double>(report.work.pairRays) });
  }
  return found;
}

testing::AssertionResult IsSame(
  const Found& found, const Found& expected, const std::vector<std::size_t>& order)
{
  for (std::size_t k = 0; k < found.radiance.size(); ++k)
  {
    const std::size_t l = 2 * order[k / 2] + k % 2;
    const bool isRadiance = found.radiance[k] != expected.radiance[l];
    if (isRadiance || found.importance[k] != expected.importance[l])
    {
      return testing::AssertionFailure()
             << (isRadiance ? "radiance, " : "importance, ") << (k % 2 == 1 ? "back" : "front")
             << " of polygon " << order[k / 2];
    }
  }
  return found.history == expected.history ? testing::AssertionSuccess()
                                           : testing::AssertionFailure() << "history";
}

} // namespace vantage::test
