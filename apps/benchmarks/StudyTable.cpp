#include "StudyTable.h"

#include "Measure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

namespace vantage::benchmarks
{

namespace
{

void PrintSummaryOf(const char* name, const std::vector<const StudyRow*>& rows)
{
  std::size_t kept = 0;
  std::vector<double> margins;
  const StudyRow* worst = rows.front();
  for (const StudyRow* row : rows)
  {
    kept += row->truth.relativeL1 <= row->asked ? 1 : 0;
    margins.push_back(row->asked / row->truth.relativeL1);
    if (row->truth.relativeL1 / row->asked > worst->truth.relativeL1 / worst->asked)
    {
      worst = row;
    }
  }
  std::printf("# asked %s: %zu runs, true <= asked in %.1f %%, median asked/true %.2f, worst "
              "true/asked %.2f (%s, seed %llu, %g)\n",
    name, rows.size(), 100.0 * static_cast<double>(kept) / static_cast<double>(rows.size()),
    Median(margins), worst->truth.relativeL1 / worst->asked, worst->scene.c_str(),
    static_cast<unsigned long long>(worst->seed), worst->asked);
}

} // namespace

void PrintStudyHead()
{
  std::printf(
    "scene,seed,asked,estimate,solve estimate,true L1,true RMSE,bias,reference noise,build cpu s,"
    "solve cpu s,image cpu s,primary s,direct s,indirect s,rays,links,elements\n");
}

void PrintStudyRow(const StudyRow& row)
{
  const EngineRun& run = row.run;
  std::printf(
    "%s,%llu,%g,%.5f,%.5f,%.5f,%.5f,%+.5f,%.5f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%llu,%zu,%zu\n",
    row.scene.c_str(), static_cast<unsigned long long>(row.seed), row.asked, run.estimate,
    run.solveEstimate, row.truth.relativeL1, row.truth.relativeRmse, row.truth.relativeBias,
    row.noise, run.buildCpu, run.solveCpu, run.imageCpu, run.view.primarySeconds,
    run.view.directSeconds, run.view.indirectSeconds, static_cast<unsigned long long>(run.rays),
    run.links, run.elements);
  std::fflush(stdout);
}

void PrintStudySummary(const std::vector<StudyRow>& rows)
{
  std::map<double, std::vector<const StudyRow*>> byAsked;
  std::vector<const StudyRow*> all;
  for (const StudyRow& row : rows)
  {
    byAsked[row.asked].push_back(&row);
    all.push_back(&row);
  }
  for (const auto& [asked, group] : byAsked)
  {
    PrintSummaryOf(std::to_string(asked).c_str(), group);
  }
  if (!all.empty())
  {
    PrintSummaryOf("all", all);
  }
}

void PrintBiasAndNoise(
  const std::vector<StudyRow>& rows, const std::vector<std::pair<std::string, Image>>& references)
{
  for (const auto& [scene, reference] : references)
  {
    std::map<double, std::vector<const StudyRow*>> byAsked;
    for (const StudyRow& row : rows)
    {
      if (row.scene == scene)
      {
        byAsked[row.asked].push_back(&row);
      }
    }
    for (const auto& [asked, group] : byAsked)
    {
      const auto n = static_cast<double>(group.size());
      if (group.size() < 2)
      {
        continue;
      }
      Image mean(reference.width, reference.height);
      for (const StudyRow* row : group)
      {
        for (std::size_t p = 0; p < mean.pixels.size(); ++p)
        {
          mean.pixels[p] += row->run.image.pixels[p] / n;
        }
      }
      double spread = 0.0;
      for (const StudyRow* row : group)
      {
        spread += Compare(row->run.image, mean).relativeL1 / n;
      }
      const ImageDifference systematic = Compare(mean, reference);
      std::printf("# %s at %g: L1 of the mean of %zu pictures %.5f, L1 noise of one %.5f, mean "
                  "error %+.5f\n",
        scene.c_str(), asked, group.size(), systematic.relativeL1,
        spread * std::sqrt(n / (n - 1.0)), systematic.relativeBias);
    }
  }
}

} // namespace vantage::benchmarks
