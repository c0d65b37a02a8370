#pragma once

#include "EngineRun.h"

#include <string>
#include <vector>

/// \file StudyTable.h
/// What many runs say together.

namespace vantage::benchmarks
{

/// One run, judged.
struct StudyRow
{
  std::string scene;
  std::uint64_t seed = 1;
  double asked = 0.0;    ///< relative L1 error
  double noise = 0.0;    ///< of the reference, relative L1
  ImageDifference truth; ///< against the reference
  EngineRun run;
};

void PrintStudyHead();
void PrintStudyRow(const StudyRow& row);

/// For each asked error and for all: the share of runs with true <= asked, the median of
/// asked / true, the worst true / asked and whose it is.
void PrintStudySummary(const std::vector<StudyRow>& rows);

/// For each scene and asked error that has several seeds, what is systematic and what is random:
/// the relative L1 error of the mean picture, and the mean relative L1 distance of pictures from
/// it (unbiased for the number of seeds), beside the mean signed error.
void PrintBiasAndNoise(
  const std::vector<StudyRow>& rows, const std::vector<std::pair<std::string, Image>>& references);

} // namespace vantage::benchmarks
