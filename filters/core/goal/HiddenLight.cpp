#include "core/goal/HiddenLight.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Refined links that Laplace's rule counts as, in each bin.
constexpr double LinksOfRule = 32.0;

std::size_t BinOf(std::uint32_t rays, std::size_t bins)
{
  std::size_t bin = 0;
  for (std::uint64_t rest = std::uint64_t(rays) + 1; rest > 1 && bin + 1 < bins; rest /= 2)
  {
    ++bin;
  }
  return bin;
}

/// The fraction that may be open, as far as the rays of a link alone can tell.
double Rule(double rays)
{
  return 1.0 / (rays + 2.0);
}

} // namespace

bool HiddenLight::Concerns(const OpenTree& tree, const Link& link)
{
  return link.visibility == 0.0 && !link.IsSelf() && HasCluster(tree, link);
}

/// Of the most that the links of a bin could carry.
double HiddenLight::Bin::Expected(double rule) const
{
  if (this->most == 0.0)
  {
    return 1.0;
  }
  const double weightOfRule = LinksOfRule / this->links;
  return (this->carried / this->most + weightOfRule * rule) / (1.0 + weightOfRule);
}

void HiddenLight::Learn(const Link& link, double throughput)
{
  const double most = link.uncertainty / Rule(link.agreeingRays);
  std::size_t b = BinOf(link.agreeingRays, this->Bins.size());
  ++this->Bins[b].links;
  this->Bins[b].most += most;
  this->Bins[b].carried += std::min(most, throughput);
  for (; b + 1 < this->Bins.size(); ++b)
  {
    const double mostRays = std::exp2(b + 1.0) - 2.0;
    this->Bins[b + 1].least = std::min(this->Bins[b].least, this->Bins[b].Expected(Rule(mostRays)));
  }
}

double HiddenLight::Doubt(const Link& link) const
{
  const Bin& own = this->Bins[BinOf(link.agreeingRays, this->Bins.size())];
  const double byRule = Rule(link.agreeingRays);
  return std::min({ byRule, own.least, own.Expected(byRule) }) / byRule;
}

} // namespace vantage
