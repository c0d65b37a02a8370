#include "SolutionAdapter.h"

#include "ArrayAdapter.h"
#include "SolvedView.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkUnsignedCharArray.h>

#include <cctype>
#include <cmath>
#include <limits>

namespace vantage
{

namespace
{

/// Adds to cell data or to the columns of a table what is asked of each record of a list.
template <typename Target, typename Record>
class Columns
{
public:
  Columns(Target* target, const std::vector<Record>& records)
    : Receiver(target)
    , Records(records)
  {
  }

  template <typename ArrayType, typename Function>
  void Add(const char* name, const Function& valueOf) const
  {
    this->Receiver->AddArray(MakeArray<ArrayType>(
      name, this->Records.size(), [&](std::size_t k) { return valueOf(this->Records[k]); }));
  }

private:
  Target* Receiver;
  const std::vector<Record>& Records;
};

/// Line k joins the points 2 k and 2 k + 1.
vtkSmartPointer<vtkCellArray> SeparateLines(vtkIdType count)
{
  auto lines = vtkSmartPointer<vtkCellArray>::New();
  lines->AllocateExact(count, 2 * count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    const vtkIdType ends[2] = { 2 * k, 2 * k + 1 };
    lines->InsertNextCell(2, ends);
  }
  return lines;
}

vtkSmartPointer<vtkStringArray> PhasesOf(const std::vector<StepReport>& history)
{
  auto phases = vtkSmartPointer<vtkStringArray>::New();
  phases->SetName("Phase");
  for (const StepReport& report : history)
  {
    phases->InsertNextValue(report.phase);
  }
  return phases;
}

void AddFieldValue(vtkDataObject* data, const char* name, double value)
{
  data->GetFieldData()->AddArray(
    MakeArray<vtkDoubleArray>(name, 1, [&](std::size_t) { return value; }));
}

vtkIdType IdOrMinusOne(std::uint32_t id)
{
  return id == None ? -1 : static_cast<vtkIdType>(id);
}

} // namespace

vtkSmartPointer<vtkPolyData> ElementsToPolyData(const ElementSolution& solution)
{
  const ElementSurface& surface = solution.surface;
  const std::size_t count = surface.PolygonCount();
  auto elements = vtkSmartPointer<vtkPolyData>::New();
  elements->SetPoints(VerticesToPoints(surface.points));
  elements->SetPolys(PolygonsToCells(surface.indices, surface.offsets));

  vtkCellData* cellData = elements->GetCellData();
  cellData->AddArray(ColorsToArray("Radiance", solution.radiance));
  if (!solution.irradiance.empty())
  {
    cellData->AddArray(ColorsToArray("Irradiance", solution.irradiance));
  }
  cellData->AddArray(ColorsToArray("UnshotRadiance", solution.unshotRadiance));
  cellData->AddArray(ColorsToArray("Importance", solution.importance));
  cellData->AddArray(ColorsToArray("UnshotImportance", solution.unshotImportance));
  cellData->AddArray(MakeArray<vtkDoubleArray>(
    "ViewImportance", count, [&](std::size_t k) { return solution.viewImportance[k]; }));
  cellData->AddArray(ColorsToArray("Albedo", solution.albedo));
  cellData->AddArray(ColorsToArray("Emission", solution.emission));
  cellData->AddArray(
    MakeArray<vtkIdTypeArray>("PatchId", count, [&](std::size_t k) { return solution.patch[k]; }));
  cellData->AddArray(MakeArray<vtkIdTypeArray>(
    "InputCellId", count, [&](std::size_t k) { return solution.scenePolygon[k]; }));
  cellData->AddArray(MakeArray<vtkUnsignedCharArray>(
    "Side", count, [&](std::size_t k) { return solution.side[k]; }));
  cellData->AddArray(
    MakeArray<vtkIntArray>("Level", count, [&](std::size_t k) { return solution.level[k]; }));

  elements->GetPointData()->AddArray(ColorsToArray("Radiance", solution.pointRadiance));
  if (!solution.pointIrradiance.empty())
  {
    elements->GetPointData()->AddArray(ColorsToArray("Irradiance", solution.pointIrradiance));
  }
  return elements;
}

vtkSmartPointer<vtkPolyData> ElementsToPolyData(
  const GatheredElements& gathered, double errorOfSolution)
{
  vtkSmartPointer<vtkPolyData> elements = ElementsToPolyData(gathered.elements);
  AddFieldValue(elements, "ErrorEstimate", std::hypot(errorOfSolution, gathered.errorEstimate));
  return elements;
}

vtkSmartPointer<vtkPolyData> InteractionsToPolyData(
  const std::vector<InteractionRecord>& interactions)
{
  using Record = InteractionRecord;
  std::vector<Vec3> ends;
  ends.reserve(2 * interactions.size());
  for (const Record& record : interactions)
  {
    ends.push_back(record.shooterCentre);
    ends.push_back(record.receiverCentre);
  }
  auto links = vtkSmartPointer<vtkPolyData>::New();
  links->SetPoints(VerticesToPoints(ends));
  links->SetLines(SeparateLines(static_cast<vtkIdType>(interactions.size())));

  const Columns<vtkCellData, Record> columns(links->GetCellData(), interactions);
  columns.Add<vtkIdTypeArray>("Shooter", [](const Record& r) { return IdOrMinusOne(r.shooter); });
  columns.Add<vtkIdTypeArray>("Receiver", [](const Record& r) { return IdOrMinusOne(r.receiver); });
  columns.Add<vtkIntArray>("ShooterLevel", [](const Record& r) { return r.shooterLevel; });
  columns.Add<vtkIntArray>("ReceiverLevel", [](const Record& r) { return r.receiverLevel; });
  columns.Add<vtkDoubleArray>("FormFactor", [](const Record& r) { return r.formFactor; });
  columns.Add<vtkDoubleArray>("Visibility", [](const Record& r) { return r.visibility; });
  columns.Add<vtkDoubleArray>("ShotFlux", [](const Record& r) { return r.shotFlux; });
  columns.Add<vtkDoubleArray>("Contribution", [](const Record& r) { return r.contribution; });
  columns.Add<vtkIdTypeArray>("Step", [](const Record& r) { return r.step; });
  return links;
}

namespace
{

/// A column for each of WorkCounters, its name with a capital letter.
void AddCounters(const std::vector<StepReport>& history, vtkDataSetAttributes* rows)
{
  std::vector<vtkSmartPointer<vtkIdTypeArray>> columns;
  ForEachCounter(WorkCounters(),
    [&](const char* counter, std::uint64_t)
    {
      std::string name = counter;
      name[0] = static_cast<char>(std::toupper(name[0]));
      columns.push_back(vtkSmartPointer<vtkIdTypeArray>::New());
      columns.back()->SetName(name.c_str());
      rows->AddArray(columns.back());
    });
  for (const StepReport& row : history)
  {
    std::size_t column = 0;
    ForEachCounter(row.work, [&](const char*, std::uint64_t count)
      { columns[column++]->InsertNextValue(static_cast<vtkIdType>(count)); });
  }
}

} // namespace

vtkSmartPointer<vtkTable> HistoryToTable(const std::vector<StepReport>& history)
{
  using Row = StepReport;
  auto table = vtkSmartPointer<vtkTable>::New();
  vtkDataSetAttributes* rows = table->GetRowData();
  const Columns<vtkDataSetAttributes, Row> columns(rows, history);
  columns.Add<vtkIdTypeArray>("Step", [](const Row& r) { return r.step; });
  rows->AddArray(PhasesOf(history));
  columns.Add<vtkIdTypeArray>("Patch", [](const Row& r) { return IdOrMinusOne(r.patch); });
  columns.Add<vtkDoubleArray>("ViewFlux", [](const Row& r) { return r.viewFlux; });
  columns.Add<vtkDoubleArray>("UnshotViewFlux", [](const Row& r) { return r.unshotViewFlux; });
  columns.Add<vtkDoubleArray>("UnshotPower", [](const Row& r) { return r.unshotPower; });
  columns.Add<vtkDoubleArray>("ErrorEstimate", [](const Row& r) { return r.errorEstimate; });
  columns.Add<vtkIdTypeArray>("Elements", [](const Row& r) { return r.elements; });
  columns.Add<vtkIdTypeArray>("Interactions", [](const Row& r) { return r.interactions; });
  columns.Add<vtkIdTypeArray>("Evaluations", [](const Row& r) { return r.work.Evaluations(); });
  columns.Add<vtkIdTypeArray>("Rays", [](const Row& r) { return r.work.Rays(); });
  columns.Add<vtkDoubleArray>("Seconds", [](const Row& r) { return r.seconds; });
  AddCounters(history, rows);
  return table;
}

namespace
{

vtkSmartPointer<vtkFloatArray> PixelsToArray(const char* name, const Image& image)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(image.pixels.size()));
  for (std::size_t k = 0; k < image.pixels.size(); ++k)
  {
    array->SetTuple(static_cast<vtkIdType>(k), &image.pixels[k].x);
  }
  return array;
}

} // namespace

vtkSmartPointer<vtkImageData> ImageToImageData(const Image& image)
{
  auto imageData = vtkSmartPointer<vtkImageData>::New();
  imageData->SetDimensions(image.width, image.height, 1);
  imageData->GetPointData()->AddArray(PixelsToArray("Radiance", image));
  return imageData;
}

vtkSmartPointer<vtkImageData> ViewToImageData(
  const GatheredView& view, const Camera& camera, const SolvedView& solved)
{
  const ImagePlane plane(camera);
  const int width = view.radiance.width;
  const int height = view.radiance.height;
  const auto cellOf = [&](std::size_t pixel)
  {
    if (view.patch[pixel] == None)
    {
      return vtkIdType(-1);
    }
    const Vec3 direction = plane.Direction(
      2.0 * (pixel % width + 0.5) / width - 1.0, 2.0 * (pixel / width + 0.5) / height - 1.0);
    const Vec3 point = plane.eye + double(view.depth[pixel]) * glm::normalize(direction);
    return static_cast<vtkIdType>(solved.CellAt(view.patch[pixel], point));
  };
  vtkSmartPointer<vtkImageData> image = ImageToImageData(view.radiance);
  vtkPointData* points = image->GetPointData();
  points->SetActiveScalars("Radiance");
  points->AddArray(PixelsToArray("Irradiance", view.irradiance));
  points->AddArray(MakeArray<vtkIdTypeArray>("ElementId", view.patch.size(), cellOf));
  points->AddArray(MakeArray<vtkFloatArray>(
    "Depth", view.depth.size(), [&](std::size_t k) { return view.depth[k]; }));
  AddFieldValue(image, "GatherErrorEstimate", view.report.errorEstimate);
  if (solved.isForItsView && solved.IsMadeFor(camera, width, height))
  {
    AddFieldValue(
      image, "ErrorEstimate", std::hypot(solved.errorEstimate, view.report.errorEstimate));
  }
  return image;
}

std::shared_ptr<const SolvedView> ViewOf(
  const Solver& solver, const ElementSolution& elements, const Camera& camera)
{
  const auto view = std::make_shared<SolvedView>();
  view->snapshot = solver.Snapshot();
  view->camera = camera;
  view->isForItsView = solver.Settings().method == Method::GoalOriented;
  view->tree = elements.tree;
  view->nodeOfCell = elements.surface.elements;
  view->errorEstimate = solver.History().empty() ? std::numeric_limits<double>::infinity()
                                                 : solver.History().back().errorEstimate;
  return view;
}

} // namespace vantage
