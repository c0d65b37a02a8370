#pragma once

#include "report/MethodRun.h"
#include "report/RunStore.h"

#include <string>
#include <vector>

/// \file ReportPage.h
/// All runs together: table, charts, pictures, and a page that shows them.

namespace vantage
{

class OffscreenDisplay;

/// What is reported.
struct SpeedReport
{
  std::string scene;         ///< name of the file
  std::string command;       ///< that makes it
  std::string referenceNote; ///< what the reference is and how noisy, a sentence or two
  std::vector<RunPlan> plans;
  std::vector<RunRecord> records; ///< of the plans, in their order
};

/// The rows of speed-vs-error.csv.
std::vector<Measurement> AllMeasurements(const SpeedReport& report);

/// Processor seconds to the TableErrors, for people. With `elementsOnly`, the pictures of methods
/// that have both kinds are those of their elements.
std::vector<std::vector<std::string>> MakeSecondsTable(
  const SpeedReport& report, bool elementsOnly = false);

/// Writes speed-vs-error.csv, error-vs-*.png, images/, interactions/ and, last, index.html into the
/// folder. \throw InputError when something cannot be written.
void WriteReport(OffscreenDisplay& display, const Target& target, const SpeedReport& report,
  const RunStore& store, const std::string& folder);

inline const std::string MeasurementFile = "speed-vs-error.csv";
inline const std::string PageFile = "index.html";

} // namespace vantage
