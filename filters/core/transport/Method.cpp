#include "core/transport/Method.h"

#include "core/Error.h"

#include <algorithm>

namespace vantage
{

namespace
{

std::string Join(const std::vector<std::string>& names)
{
  std::string joined;
  for (const std::string& name : names)
  {
    joined += (joined.empty() ? "" : ", ") + name;
  }
  return joined;
}

/// Index of a name in a list that is in the order of its enumeration.
std::size_t IndexOf(
  const std::string& kind, const std::string& name, const std::vector<std::string>& names)
{
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
  {
    throw UnknownNameError(kind, name, Join(names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

const std::vector<std::string>& GranularityNames()
{
  static const std::vector<std::string> names{ "interaction", "patch" };
  return names;
}

} // namespace

const std::vector<std::string>& MethodNames()
{
  static const std::vector<std::string> names{ "basic-shooting", "progressive-shooting",
    "importance-shooting", "goal-oriented", "gauss-seidel", "importance-gathering" };
  return names;
}

std::vector<std::string> FixedGraphMethodNames()
{
  std::vector<std::string> names = MethodNames();
  names.erase(std::find(names.begin(), names.end(), NameOf(Method::GoalOriented)));
  return names;
}

std::string NameOf(Method method)
{
  return MethodNames()[static_cast<std::size_t>(method)];
}

bool UsesImportance(Method method)
{
  return method == Method::ImportanceShooting || method == Method::ImportanceGathering;
}

bool Gathers(Method method)
{
  return method == Method::GaussSeidel || method == Method::ImportanceGathering;
}

Method MethodFromName(const std::string& name)
{
  return static_cast<Method>(IndexOf("method", name, MethodNames()));
}

std::string NameOf(Granularity granularity)
{
  return GranularityNames()[static_cast<std::size_t>(granularity)];
}

Granularity GranularityFromName(const std::string& name)
{
  return static_cast<Granularity>(IndexOf("granularity", name, GranularityNames()));
}

} // namespace vantage
