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
  return link.visibility == 0.0 && !link.IsSelf() && KindOf(tree, link) == WithCluster;
}

void HiddenLight::Learn(const Link& link, double throughput)
{
  const double most = link.uncertainty / Rule(link.agreeingRays);
  Bin& bin = this->Bins[BinOf(link.agreeingRays, this->Bins.size())];
  ++bin.links;
  bin.most += most;
  bin.carried += std::min(most, throughput);
}

double HiddenLight::Doubt(const Link& link) const
{
  const std::size_t own = BinOf(link.agreeingRays, this->Bins.size());
  const double byRule = Rule(link.agreeingRays);
  double expected = byRule;
  for (std::size_t b = 0; b <= own; ++b)
  {
    const Bin& bin = this->Bins[b];
    if (bin.most > 0.0)
    {
      const double rule = b == own ? byRule : Rule(std::exp2(b + 1.0) - 2.0);
      const double weightOfRule = LinksOfRule / bin.links;
      expected =
        std::min(expected, (bin.carried / bin.most + weightOfRule * rule) / (1.0 + weightOfRule));
    }
  }
  return expected / byRule;
}

} // namespace vantage
