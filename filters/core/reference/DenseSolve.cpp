#include "core/reference/DenseSolve.h"

#include "core/Error.h"
#include "core/formfactor/FormFactor.h"
#include "core/math/Sampling.h"
#include "core/visibility/PairVisibility.h"

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include <optional>
#include <string>

namespace vantage
{

namespace
{

constexpr std::size_t MaximumElements = 20000;

/// Form factors are good to about 1e-5, so that a larger gain cannot be told from an infinite one.
constexpr double LargestGain = 1e4;

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Throughput between two elements with exact shadows.
double ShadowedThroughput(
  const OccluderScene& occluders, const VisibilityEnd& a, const VisibilityEnd& b)
{
  const PairVisibility seen = EstimateVisibility(occluders, a, b, 1, 0);
  if (seen.isCertain)
  {
    return seen.fraction > 0.0 ? Throughput(a.shape, b.shape) : 0.0;
  }
  const double tolerance = occluders.Tolerance();
  const auto shaft = Shaft(ClipToFront(a.shape, SupportingPlane(b.shape), tolerance),
    ClipToFront(b.shape, SupportingPlane(a.shape), tolerance), tolerance);
  if (!shaft)
  {
    // Two elements that face each other only by round-off.
    return 0.0;
  }
  std::vector<Polygon> between;
  for (const std::uint32_t facet : occluders.FacetsInRegion(*shaft))
  {
    between.push_back(occluders.Shape(facet));
  }
  return VisibleThroughput(a.shape, b.shape, between);
}

/// What an element does to light.
struct Surface
{
  Color albedo;
  Color emission;
};

Surface SurfaceOf(const Scene& scene, const FacetSet& facets, const Patch& patch)
{
  const Facet& facet = facets.facets[patch.facet];
  const Material& material = scene.materials[facet.MaterialOf(patch.side)];
  return { material.albedo, facet.IsPolygonFront(patch.side) ? material.emission : Color(0.0) };
}

std::vector<NodeId> SplitUniformly(ElementTree& tree, int level)
{
  std::vector<NodeId> elements;
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsCluster())
    {
      continue;
    }
    if (tree[id].level < level)
    {
      tree.Split(id);
    }
    else
    {
      elements.push_back(id);
    }
  }
  return elements;
}

/// (1 - rho F) for one channel, factorised; refuses systems that have no finite solution.
class Operator
{
public:
  Operator(const DenseSolution& solution, const Eigen::VectorXd& albedo)
    : Albedo(albedo)
  {
    const Eigen::Index n = albedo.size();
    Matrix system = Eigen::Map<const Matrix>(solution.throughput.data(), n, n);
    for (Eigen::Index i = 0; i < n; ++i)
    {
      system.row(i) *= -albedo[i] / (Pi * solution.tree[solution.elements[i]].area);
    }
    system.diagonal().array() += 1.0;
    this->Factors.compute(system);
    this->RequireFiniteGain();
  }

  bool IsOf(const Eigen::VectorXd& albedo) const { return this->Albedo == albedo; }
  Eigen::VectorXd Solve(const Eigen::VectorXd& emission) const
  {
    return this->Factors.solve(emission);
  }

private:
  /// Radiance where everything emits 1: as the inverse has no negative entries, its largest value
  /// is the norm of the inverse, and it is not positive when light grows without end.
  void RequireFiniteGain() const
  {
    const Eigen::VectorXd gain = this->Factors.solve(Eigen::VectorXd::Ones(this->Albedo.size()));
    if (!(gain.minCoeff() > 0.0 && gain.maxCoeff() < LargestGain))
    {
      throw DivergenceError("dense solve: light is never absorbed, the radiance has no finite "
                            "value (albedo 1 in a closed scene); lower the albedo below 0.999 or "
                            "open the scene");
    }
  }

  Eigen::VectorXd Albedo;
  Eigen::PartialPivLU<Matrix> Factors;
};

void SolveRadiance(DenseSolution& solution, const Scene& scene, const FacetSet& facets)
{
  const std::size_t n = solution.elements.size();
  solution.radiance.assign(n, Color(0.0));
  std::optional<Operator> transport;
  for (int channel = 0; channel < 3; ++channel)
  {
    Eigen::VectorXd albedo(n);
    Eigen::VectorXd emission(n);
    for (std::size_t i = 0; i < n; ++i)
    {
      const Surface surface =
        SurfaceOf(scene, facets, solution.tree.PatchOfNode(solution.elements[i]));
      albedo[i] = surface.albedo[channel];
      emission[i] = surface.emission[channel];
    }
    if (!transport || !transport->IsOf(albedo))
    {
      transport.emplace(solution, albedo);
    }
    const Eigen::VectorXd radiance = transport->Solve(emission);
    for (std::size_t i = 0; i < n; ++i)
    {
      solution.radiance[i][channel] = radiance[i];
    }
  }
}

void RequireWithin(std::int64_t value, std::int64_t low, std::int64_t high, const char* name)
{
  if (value < low || value > high)
  {
    throw InputError("dense solve: " + std::string(name) + " is " + std::to_string(value) +
                     "; give a number from " + std::to_string(low) + " to " + std::to_string(high));
  }
}

} // namespace

void DenseSettings::Validate() const
{
  RequireWithin(this->level, 0, 6, "level");
  RequireWithin(this->rays, 1, 4096, "rays");
}

std::vector<double> DenseThroughput(const FacetSet& facets, const ElementTree& tree,
  const std::vector<NodeId>& elements, const DenseSettings& settings)
{
  const OccluderScene occluders(facets);
  const std::size_t n = elements.size();
  std::vector<double> throughput(n * n, 0.0);
  const auto end = [&](std::size_t i) {
    return VisibilityEnd{ tree.Shape(elements[i]), tree.PatchOfNode(elements[i]).facet };
  };
  const auto between = [&](std::size_t i, std::size_t j)
  {
    if (settings.exactVisibility)
    {
      return ShadowedThroughput(occluders, end(i), end(j));
    }
    const double fraction =
      EstimateVisibility(occluders, end(i), end(j), settings.rays, Hash(i, j)).fraction;
    return fraction > 0.0 ? fraction * Throughput(end(i).shape, end(j).shape) : 0.0;
  };
  tbb::parallel_for(std::size_t{ 0 }, n,
    [&](std::size_t i)
    {
      for (std::size_t j = i + 1; j < n; ++j)
      {
        throughput[i * n + j] = throughput[j * n + i] = between(i, j);
      }
    });
  return throughput;
}

DenseSolution SolveDense(const Scene& scene, const DenseSettings& settings)
{
  settings.Validate();
  const FacetSet facets = BuildFacets(scene);
  DenseSolution solution{ ElementTree(facets, scene.materials), {}, {}, {} };
  const std::size_t count = solution.tree.LeafElementCount() << (2 * settings.level);
  if (count > MaximumElements)
  {
    throw InputError("dense solve: " + std::to_string(count) + " elements are more than " +
                     std::to_string(MaximumElements) + "; choose a lower level or a smaller scene");
  }
  solution.elements = SplitUniformly(solution.tree, settings.level);
  solution.throughput = DenseThroughput(facets, solution.tree, solution.elements, settings);
  SolveRadiance(solution, scene, facets);
  return solution;
}

} // namespace vantage
