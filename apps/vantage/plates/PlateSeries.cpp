#include "plates/PlateSeries.h"

#include "core/Error.h"
#include "core/view/ToneMapping.h"
#include "plates/ContactSheet.h"
#include "plates/OffscreenDisplay.h"
#include "plates/PlatePainter.h"
#include "plates/SolutionPipeline.h"
#include "plates/ViewReference.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>
#include <vtkImageData.h>
#include <vtkPolyData.h>

namespace vantage
{

namespace
{

constexpr std::uint64_t FewSteps = 60;
constexpr std::uint64_t ManySteps = 250;
constexpr double CoarseError = 0.3; ///< parts that are unshot
constexpr double FineError = 0.01;
/// Interiors look right brighter than middle grey, by this power of two.
constexpr double Brightening = 1.0;

/// What is done until each part of the work begins.
constexpr double Traced1 = 0.05;
constexpr double Traced2 = 0.4;
constexpr double Plates1 = 0.75;
constexpr double Plates2 = 0.85;
constexpr double Plates3 = 0.92;
constexpr double SheetBegins = 0.97;

std::string Percent(double part)
{
  std::ostringstream text;
  text << std::setprecision(2) << 100.0 * part << " %";
  return text.str();
}

/// Makes the series, one part after the other.
class Maker
{
public:
  Maker(OffscreenDisplay& display, const std::string& path, const Scene& scene,
    const PlateSettings& settings, const PlateProgress& progress)
    : Display(display)
    , Path(path)
    , Polygons(scene.PolygonCount())
    , Settings(settings)
    , Progress(progress)
    , Overview(this->CameraOf(scene, "overview"))
    , View1(this->CameraOf(scene, "view1"))
    , View2(this->CameraOf(scene, "view2"))
    , WithoutImportance(path, Method::ProgressiveShooting)
    , Direct(this->SolveDirect())
    , Reference1(this->Trace(scene, this->View1, Traced1, Traced2))
    , Reference2(this->Trace(scene, this->View2, Traced2, Plates1))
    , Painter(display, settings.width, settings.height,
        AutomaticExposure(this->Reference1.Radiance().pixels) + Brightening)
  {
  }

  PlateSeries Make()
  {
    this->MakePlates1();
    SolutionPipeline pipeline(this->Path, Method::ImportanceShooting);
    this->Progress(Plates2, "plates 2");
    this->MakePlatesOfView("2", "first view", this->View1, "5 min", pipeline);
    this->Progress(Plates3, "plates 3");
    this->MakePlatesOfView("3", "second view", this->View2, "", pipeline);
    this->Progress(SheetBegins, "contact sheet");
    this->WriteNotes();
    this->Result.sheet = DrawContactSheet(this->Display, this->MakeSheet());
    return this->Result;
  }

private:
  Camera CameraOf(const Scene& scene, const std::string& name) const
  {
    Camera camera = scene.FindCamera(name);
    camera.aspect = static_cast<double>(this->Settings.width) / this->Settings.height;
    return camera;
  }

  ViewReference Trace(const Scene& scene, const Camera& camera, double begin, double end) const
  {
    return ViewReference(scene, camera, this->Settings.referenceSamples,
      [&](double part)
      {
        this->Progress(begin + part * (end - begin), "path tracing " + camera.name);
        return true;
      });
  }

  /// Before the references: in a scene that has no solution, paths to trace have no end.
  SolutionState SolveDirect()
  {
    this->WithoutImportance.SetCamera(this->View1);
    return this->WithoutImportance.SolveSteps(0);
  }

  /// The whole scene from above.
  void MakePlates1()
  {
    this->Progress(Plates1, "plates 1");
    SolutionPipeline& pipeline = this->WithoutImportance;
    this->AddRow(
      "1a", "direct light", this->Direct, pipeline, "7,000 elements, 14,500 interactions, 2 min");
    const SolutionState few = pipeline.SolveSteps(FewSteps);
    this->AddRow("1b", "60 steps without importance", few, pipeline, "6 min");
    const SolutionState many = pipeline.SolveSteps(ManySteps);
    this->AddRow("1c", "250 steps without importance", many, pipeline, "30 min");
    const SolutionState converged = pipeline.SolveError(FineError);
    this->AddRow("", "without importance, " + Percent(FineError) + " unshot", converged, pipeline,
      "more than 40 min");

    this->Painter.SetRooms(converged.elements, this->Overview);
    this->AddPlate("1a", "1a", "Direct light", this->Painter.DrawFromAbove(this->Direct.elements));
    this->AddPlate(
      "1b", "1b", "60 steps without importance", this->Painter.DrawFromAbove(few.elements));
    this->AddPlate(
      "1c", "1c", "250 steps without importance", this->Painter.DrawFromAbove(many.elements));
    this->AddPlate("1d", "1b", "Interactions of 1b, coloured by the flux they carry",
      this->Painter.DrawInteractionsFromAbove(few.interactions, "ShotFlux", "Flux carried [W]"));
  }

  /// A view with importance, on the interactions that the pipeline has already.
  void MakePlatesOfView(const std::string& family, const std::string& view, const Camera& camera,
    const std::string& paper, SolutionPipeline& pipeline)
  {
    const std::string a = family + "a";
    const std::string b = family + "b";
    const std::string c = family + "c";
    pipeline.SetCamera(camera);
    const SolutionState coarse = pipeline.SolveError(CoarseError);
    this->AddRow(a, view + ", " + Percent(CoarseError) + " unshot", coarse, pipeline, "");
    this->AddPlate(a, a, "The " + view + ", " + Percent(CoarseError) + " unshot",
      this->Painter.DrawView(camera, pipeline.GetSolver()));
    const SolutionState fine = pipeline.SolveError(FineError);
    this->AddRow(b, view + ", " + Percent(FineError) + " unshot", fine, pipeline, paper);
    this->AddPlate(b, b, "The " + view + ", " + Percent(FineError) + " unshot",
      this->Painter.DrawView(camera, pipeline.GetSolver()));
    this->AddPlate(c, b, "Interactions of " + b + ", coloured by what they mean for the view",
      this->Painter.DrawInteractionsTwice(
        fine.interactions, camera, "Contribution", "Contribution to the view [W/m\u00b2]"));
  }

  void AddRow(const std::string& plate, const std::string& description, const SolutionState& state,
    const SolutionPipeline& pipeline, const std::string& paper)
  {
    PlateRow row;
    row.plate = plate;
    row.description = description;
    row.steps = state.steps;
    row.elements = static_cast<std::size_t>(state.elements->GetNumberOfCells());
    row.interactions = static_cast<std::size_t>(state.interactions->GetNumberOfCells());
    row.evaluations = state.evaluations;
    row.rays = state.rays;
    row.seconds = state.seconds;
    row.errorOfView1 = this->Reference1.ErrorOf(pipeline.GetSolver());
    row.errorOfView2 = this->Reference2.ErrorOf(pipeline.GetSolver());
    row.paper = paper;
    this->Result.rows.push_back(row);
  }

  void AddPlate(const std::string& name, const std::string& solution, const std::string& caption,
    vtkSmartPointer<vtkImageData> image)
  {
    this->Result.plates.push_back({ name, solution, caption, image });
  }

  void WriteNotes()
  {
    this->Result.notes = { "Errors: relative L1 against the path tracer, whose own noise is " +
                             Percent(this->Reference1.Noise()) + " of view 1 and " +
                             Percent(this->Reference2.Noise()) +
                             " of view 2. Unshot: a part of the light of the view; without "
                             "importance, of all light.",
      "Steps, evaluations, rays and seconds count from where the view was chosen; the second view "
      "goes on with the elements and interactions of the first.",
      "In the paper: what Bekaert and Willems (1995) report of a labyrinth of 378 patches on the "
      "machine they had." };
  }

  Sheet MakeSheet() const
  {
    Sheet sheet;
    sheet.title = "A progressive importance-driven rendering algorithm: the plates";
    sheet.subtitle = "After Bekaert and Willems (1995). " +
                     std::filesystem::path(this->Path).filename().string() + ", " +
                     std::to_string(this->Polygons) + " polygons. All plates at the same exposure.";
    for (const Plate& plate : this->Result.plates)
    {
      const auto row = std::find_if(this->Result.rows.begin(), this->Result.rows.end(),
        [&](const PlateRow& candidate) { return candidate.plate == plate.solution; });
      SheetPicture picture;
      picture.image = plate.image;
      picture.name = plate.name;
      picture.caption = plate.caption;
      picture.figures = DescribeRow(*row);
      picture.row = plate.name[0] - '1';
      picture.column = plate.name[1] - 'a';
      picture.columns = plate.name == "2c" || plate.name == "3c" ? 2 : 1;
      sheet.pictures.push_back(picture);
    }
    sheet.table = FormatPlateTable(this->Result.rows);
    sheet.notes = this->Result.notes;
    return sheet;
  }

  OffscreenDisplay& Display;
  std::string Path;
  std::size_t Polygons;
  PlateSettings Settings;
  PlateProgress Progress;
  Camera Overview, View1, View2;
  SolutionPipeline WithoutImportance;
  SolutionState Direct;
  ViewReference Reference1, Reference2;
  PlatePainter Painter;
  PlateSeries Result;
};

void RequireRange(const std::string& name, int value, int lowest, int highest)
{
  if (value < lowest || value > highest)
  {
    throw InputError(name + " " + std::to_string(value) +
                     " is out of range; give an integer from " + std::to_string(lowest) + " to " +
                     std::to_string(highest));
  }
}

} // namespace

void PlateSettings::Validate() const
{
  RequireRange("--size: width", this->width, 16, 8192);
  RequireRange("--size: height", this->height, 16, 8192);
  RequireRange("--reference-samples:", this->referenceSamples, 2, 1000000);
}

void RequirePlateScene(const Scene& scene)
{
  if (std::none_of(scene.materialOfPolygon.begin(), scene.materialOfPolygon.end(),
        [&](std::uint32_t material)
        { return MaxChannel(scene.materials[material].emission) > 0.0; }))
  {
    throw InputError("scene: nothing in it emits light; give a material an emission");
  }
  for (const std::string name : { "view1", "view2", "overview" })
  {
    if (std::none_of(scene.cameras.begin(), scene.cameras.end(),
          [&](const Camera& camera) { return camera.name == name; }))
    {
      throw InputError("scene: it has no camera '" + name +
                       "'; plates need view1, view2 and overview, as 'vantage labyrinth' makes "
                       "them");
    }
  }
}

PlateSeries MakePlates(OffscreenDisplay& display, const std::string& path, const Scene& scene,
  const PlateSettings& settings, const PlateProgress& progress)
{
  settings.Validate();
  return Maker(display, path, scene, settings, progress).Make();
}

} // namespace vantage
