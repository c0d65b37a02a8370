#include "report/ReportPage.h"

#include "CommandLine.h"
#include "TextTable.h"
#include "VtkFile.h"
#include "core/Error.h"
#include "io/AtomicFile.h"
#include "io/TextLines.h"
#include "plates/OffscreenDisplay.h"
#include "report/HtmlPage.h"
#include "report/Provenance.h"
#include "report/ReachTable.h"
#include "report/ReportFigures.h"
#include "report/ReportOptions.h"
#include "report/SpeedChart.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <vtkImageData.h>

namespace vantage
{

namespace
{

namespace fs = std::filesystem;

constexpr int ChartWidth = 900;
constexpr int ChartHeight = 520;
const std::string Yardstick = NameOf(Method::GoalOriented);

double CpuSecondsOf(const Measurement& m)
{
  return m.CpuSeconds();
}
double RaysOf(const Measurement& m)
{
  return static_cast<double>(m.rays);
}
double InteractionsOf(const Measurement& m)
{
  return static_cast<double>(m.interactions);
}

/// A curve for each method that was measured.
std::vector<MeasuredCurve> CurvesOf(const SpeedReport& report, bool elementsOnly)
{
  std::vector<MeasuredCurve> curves;
  for (const std::string& method : ReportMethodNames())
  {
    MeasuredCurve curve{ method, {} };
    for (const Measurement& m : AllMeasurements(report))
    {
      const bool isLeftOut = elementsOnly && m.picture == picture::Gathered && method != Yardstick;
      if (m.method == method && !isLeftOut)
      {
        curve.measurements.push_back(m);
      }
    }
    if (!curve.measurements.empty())
    {
      curves.push_back(curve);
    }
  }
  return curves;
}

SpeedChart MakeChart(const std::vector<MeasuredCurve>& curves, const Cost& cost,
  const std::string& title, const std::string& costTitle)
{
  const std::vector<std::string> names = ReportMethodNames();
  SpeedChart chart;
  chart.title = title;
  chart.costTitle = costTitle;
  for (const MeasuredCurve& curve : curves)
  {
    const std::vector<CurvePoint> points = LowerEnvelope(curve.measurements, cost);
    if (!points.empty())
    {
      // By place in the list of all, so that a method looks the same in every report.
      const auto place = std::find(names.begin(), names.end(), curve.method) - names.begin() + 1;
      const auto style = curve.method == PathTracingName ? 0 : static_cast<std::size_t>(place);
      chart.curves.push_back({ curve.method, style, points });
    }
  }
  return chart;
}

void CopyAtomically(const std::string& from, const std::string& to)
{
  WriteAtomically(to, [&](const std::string& temporary)
    { fs::copy_file(from, temporary, fs::copy_options::overwrite_existing); });
}

/// Writes one report.
class Writer
{
public:
  Writer(OffscreenDisplay& display, const Target& target, const SpeedReport& report,
    const RunStore& store, const std::string& folder)
    : Display(display)
    , Goal(target)
    , Report(report)
    , Store(store)
    , Folder(folder)
    , Best(CurvesOf(report, false))
    , ElementsOnly(CurvesOf(report, true))
  {
  }

  void Write()
  {
    WriteTextAtomically(
      this->PathOf(MeasurementFile), PrintMeasurements(AllMeasurements(this->Report)));
    Page page;
    page.title = "Speed against error: " + this->Report.scene;
    page.subtitle = "View " + this->Goal.camera.name + ", " + std::to_string(this->Goal.width) +
                    " x " + std::to_string(this->Goal.height) + " pixels, " +
                    Grouped(this->Goal.scene.PolygonCount()) + " polygons";
    page.sections = { this->Summary(), this->Charts(), this->Pictures(), this->Interactions(),
      this->Methodology(), this->AllRuns() };
    page.sections.erase(std::remove_if(page.sections.begin(), page.sections.end(),
                          [](const PageSection& section) { return section.heading.empty(); }),
      page.sections.end());
    WriteTextAtomically(this->PathOf(PageFile), PrintPage(page));
  }

private:
  std::string PathOf(const std::string& name) const
  {
    return (fs::path(this->Folder) / name).string();
  }

  /// Tables of what it takes to reach an error.
  PageSection Summary() const
  {
    PageSection section;
    section.heading = "What it takes to come near";
    section.paragraphs = {
      "Each method at its best: over all that was tried, the cheapest way to "
      "a picture of that error, interpolated between measured pictures. Ratios "
      "are to " +
      Yardstick + "."
    };
    section.tables = { { "Processor seconds, solution and picture",
                         MakeReachTable(this->Best, CpuSecondsOf, Yardstick, " s") },
      { "The same where methods of the paper show their elements, as the paper does",
        MakeReachTable(this->ElementsOnly, CpuSecondsOf, Yardstick, " s") },
      { "Rays of solution and picture", MakeReachTable(this->Best, RaysOf, Yardstick, "") },
      { "Interactions", MakeReachTable(this->Best, InteractionsOf, Yardstick, "") } };
    return section;
  }

  PageFigure DrawChart(const std::vector<MeasuredCurve>& curves, const Cost& cost,
    const std::string& name, const std::string& title, const std::string& costTitle) const
  {
    const std::string path = this->PathOf("error-vs-" + name + ".png");
    const SpeedChart chart = MakeChart(curves, cost, title, costTitle);
    if (chart.curves.empty()) // of path tracing there are no interactions
    {
      return {};
    }
    WritePng(DrawSpeedChart(this->Display, chart, ChartWidth, ChartHeight), path);
    return { path, title + ". Each method at its best; to the left and below is better." };
  }

  PageSection Charts() const
  {
    PageSection section;
    section.heading = "Error against cost";
    section.hasCharts = true;
    const std::vector<PageFigure> figures = { this->DrawChart(this->Best, CpuSecondsOf,
                                                "cpu-seconds", "Error against processor time",
                                                "Processor time of solution and picture [s]"),
      this->DrawChart(this->ElementsOnly, CpuSecondsOf, "cpu-seconds-of-elements",
        "Error against processor time, methods of the paper shown by their elements",
        "Processor time of solution and picture [s]"),
      this->DrawChart(
        this->Best, RaysOf, "rays", "Error against rays", "Rays of solution and picture"),
      this->DrawChart(this->Best, InteractionsOf, "interactions", "Error against interactions",
        "Interactions of the solution") };
    std::copy_if(figures.begin(), figures.end(), std::back_inserter(section.figures),
      [](const PageFigure& figure) { return !figure.path.empty(); });
    return section;
  }

  /// Processor time of the yardstick's first picture within the least of the TableErrors, or else
  /// of its best one.
  double FairSeconds() const
  {
    double seconds = std::numeric_limits<double>::infinity();
    for (const MeasuredCurve& curve : this->Best)
    {
      if (curve.method == Yardstick)
      {
        for (const CurvePoint& point : LowerEnvelope(curve.measurements, CpuSecondsOf))
        {
          seconds = point.cost;
          if (point.error <= TableErrors.back())
          {
            break;
          }
        }
      }
    }
    return seconds;
  }

  /// The best picture within that time, or the quickest one there is.
  static const Measurement& Choose(const MeasuredCurve& curve, double seconds)
  {
    return *std::min_element(curve.measurements.begin(), curve.measurements.end(),
      [seconds](const Measurement& a, const Measurement& b)
      {
        const bool isInTimeA = a.CpuSeconds() <= seconds;
        const bool isInTimeB = b.CpuSeconds() <= seconds;
        if (isInTimeA != isInTimeB)
        {
          return isInTimeA;
        }
        return isInTimeA ? a.error < b.error : a.CpuSeconds() < b.CpuSeconds();
      });
  }

  PageSection Pictures() const
  {
    const double seconds = this->FairSeconds();
    PageSection section;
    section.heading = "Pictures of equal time";
    section.isSideBySide = true;
    section.paragraphs = {
      "The best picture of each method within the processor time in which " + Yardstick +
      " comes within " + PrintNumber(100.0 * TableErrors.back()) +
      " %, or else its quickest one; beside it the difference to the reference: orange is too "
      "bright, blue too dark, by the logarithm of the difference from " +
      PrintNumber(100.0 * LeastDifference) + " % of the mean radiance (white) to " +
      PrintNumber(100.0 * MostDifference) + " %. All at the same exposure."
    };
    PrepareFolder(this->PathOf("images"));
    const std::string reference = this->PathOf("images/reference.png");
    WritePicture(this->Goal, this->Goal.reference, reference);
    for (const MeasuredCurve& curve : this->Best)
    {
      const Measurement& chosen = Choose(curve, seconds);
      const std::string image = this->PathOf("images/" + curve.method + ".png");
      const std::string difference = this->PathOf("images/" + curve.method + "-difference.png");
      CopyAtomically(this->Store.PathOf(chosen.image), image);
      CopyAtomically(this->Store.PathOf(chosen.differenceImage), difference);
      section.figures.push_back({ image, curve.method + ", " + chosen.picture + ": error " +
                                           TwoDigits(100.0 * chosen.error) + " % in " +
                                           TwoDigits(chosen.CpuSeconds()) + " s" });
      section.figures.push_back({ difference, curve.method + ", difference to the reference" });
    }
    section.figures.push_back({ reference, "The reference" });
    return section;
  }

  PageSection Interactions() const
  {
    PageSection section;
    for (std::size_t k = 0; k < this->Report.records.size(); ++k)
    {
      const RunRecord& record = this->Report.records[k];
      const RunPlan& plan = this->Report.plans[k];
      if (record.interactionImage.empty())
      {
        continue;
      }
      PrepareFolder(this->PathOf("interactions"));
      const std::string path = this->PathOf("interactions/" + plan.method + ".png");
      CopyAtomically(this->Store.PathOf(record.interactionImage), path);
      section.figures.push_back({ path, plan.Title() + ": " + record.interactionCaption });
    }
    if (!section.figures.empty())
    {
      section.heading = "Interactions";
      section.paragraphs = { "What each method solved on when the asked error was " +
                             PrintNumber(100.0 * ExampleError) + " % or next to it." };
    }
    return section;
  }

  PageSection Methodology() const
  {
    PageSection section;
    section.heading = "How it was measured";
    section.paragraphs = {
      "Error is the sum of absolute differences to the reference over the sum of the reference, at "
      "the centres of all pixels (relative L1). " +
        this->Report.referenceNote,
      "Processor time is that of all threads for the solution and for its picture, from a built "
      "scene: reading the scene and building what rays are traced through are the same for all and "
      "not counted. Rays count both as well.",
      Yardstick + " was asked for each of the errors. Its picture is gathered at the pixels, as "
                  "vantage render does it.",
      "The other methods of the solver work on a graph whose fineness does not follow the picture, "
      "so that their error has a floor; each was run at several power tolerances and solved until "
      "the asked parts were unshot. Every solution was shown in two ways, each with its own time: "
      "by its elements, interpolated, as Bekaert and Willems (1995) show theirs; and gathered by "
      "the same code and to the same errors as " +
        Yardstick +
        ". The better one counts, so that what is left are differences of the solutions; where "
        "only "
        "elements count, it is said.",
      "path-tracing connects each vertex of its paths to a lamp (next-event estimation) and began "
      "anew for each number of samples.",
      "A run ends when its processor time of solving is up; the picture of that moment is the last "
      "one, "
      "marked as cut short.",
      "Command: " + this->Report.command, "Vantage " + ProgramVersion() + "; " + LibraryVersions(),
      "Machine: " + MachineDescription()
    };
    return section;
  }

  PageSection AllRuns() const
  {
    PageSection section;
    section.isFolded = true;
    const std::vector<Measurement> measurements = AllMeasurements(this->Report);
    section.heading = "All " + std::to_string(measurements.size()) + " pictures";
    PageTable table;
    table.caption = "As in " + MeasurementFile;
    table.cells = { { "method", "picture", "power tolerance", "budget", "cut short", "steps",
      "elements", "interactions", "rays", "error", "bias", "solution", "picture" } };
    for (const Measurement& m : measurements)
    {
      table.cells.push_back({ m.method, m.picture,
        m.powerTolerance > 0.0 ? PrintNumber(m.powerTolerance) : "", PrintNumber(m.budget),
        m.isCutShort ? "yes" : "", Grouped(m.steps), Grouped(m.elements), Grouped(m.interactions),
        Grouped(m.rays), Fixed(100.0 * m.error, 2) + " %", Fixed(100.0 * m.bias, 2) + " %",
        Fixed(m.solveCpuSeconds, 3) + " s", Fixed(m.imageCpuSeconds, 3) + " s" });
    }
    section.tables.push_back(table);
    return section;
  }

  OffscreenDisplay& Display;
  const Target& Goal;
  const SpeedReport& Report;
  const RunStore& Store;
  std::string Folder;
  std::vector<MeasuredCurve> Best, ElementsOnly;
};

} // namespace

std::vector<Measurement> AllMeasurements(const SpeedReport& report)
{
  std::vector<Measurement> all;
  for (const RunRecord& record : report.records)
  {
    all.insert(all.end(), record.measurements.begin(), record.measurements.end());
  }
  return all;
}

std::vector<std::vector<std::string>> MakeSecondsTable(const SpeedReport& report, bool elementsOnly)
{
  return MakeReachTable(CurvesOf(report, elementsOnly), CpuSecondsOf, Yardstick, " s");
}

void WriteReport(OffscreenDisplay& display, const Target& target, const SpeedReport& report,
  const RunStore& store, const std::string& folder)
{
  Writer(display, target, report, store, folder).Write();
}

} // namespace vantage
