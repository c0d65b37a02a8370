#include "view/ViewWindow.h"

#include "VtkFile.h"
#include "io/CameraFile.h"
#include "view/Walking.h"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <utility>
#include <vtkCamera.h>
#include <vtkImageActor.h>
#include <vtkImageData.h>
#include <vtkImageMapper3D.h>
#include <vtkInteractorStyle.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

namespace vantage
{

namespace
{

/// Milliseconds between two looks for a new picture.
constexpr unsigned long Interval = 20;
/// Of a key or a notch of the wheel, over the distance to what the first camera looks at.
constexpr double StepLength = 0.05;
constexpr double ExposureStep = 1.0 / 3.0;

/// Events of the window as what they ask for. Nothing of VTK's own keys is left.
class WalkingStyle : public vtkInteractorStyle
{
public:
  static WalkingStyle* New();
  vtkTypeMacro(WalkingStyle, vtkInteractorStyle)

  std::function<void(int, int)> Drag; ///< by so many pixels to the right, and up
  std::function<void(double)> Roll;   ///< by so many notches forward
  std::function<void(const std::string&)> Press;
  std::function<void()> Tick;
  std::function<void()> Resize;

  void OnLeftButtonDown() override { this->IsDragging = true; }
  void OnLeftButtonUp() override { this->IsDragging = false; }
  void OnMouseMove() override
  {
    const int* now = this->Interactor->GetEventPosition();
    const int* before = this->Interactor->GetLastEventPosition();
    if (this->IsDragging)
    {
      this->Drag(now[0] - before[0], now[1] - before[1]);
    }
  }
  void OnMouseWheelForward() override { this->Roll(1.0); }
  void OnMouseWheelBackward() override { this->Roll(-1.0); }
  void OnKeyPress() override { this->Press(this->Interactor->GetKeySym()); }
  void OnChar() override {}
  void OnTimer() override { this->Tick(); }
  void OnConfigure() override { this->Resize(); }

private:
  bool IsDragging = false;
};

vtkStandardNewMacro(WalkingStyle)

} // namespace

class ViewWindow::Implementation
{
public:
  Implementation(ProgressiveView& view, const Settings& settings)
    : View(&view)
    , Title(settings.title)
    , Places(settings.places)
    , Now(settings.start)
    , Step(StepLength * glm::distance(settings.start.eye, settings.start.lookAt))
    , Tone(settings.toneMapping)
  {
    this->BindKeys();
    this->Style->Drag = [this](int right, int up) { this->Drag(right, up); };
    this->Style->Roll = [this](double notches) { this->Go(notches, 0.0, 0.0); };
    this->Style->Press = [this](const std::string& key) { this->Press(key); };
    this->Style->Tick = [this] { this->Poll(); };
    this->Style->Resize = [this] { this->FollowSize(); };
    this->Canvas->GetActiveCamera()->ParallelProjectionOn();
    this->Actor->GetMapper()->BorderOn();
    this->Window->SetSize(settings.width, settings.height);
    this->Window->SetWindowName(settings.title.c_str());
    this->Window->AddRenderer(this->Canvas);
    this->Events->SetRenderWindow(this->Window);
    this->Events->SetInteractorStyle(this->Style);
  }

  void Run()
  {
    this->Window->Render();
    this->Events->Initialize();
    this->Events->CreateRepeatingTimer(Interval);
    this->Look();
    this->Events->Start();
    if (this->Failure)
    {
      std::rethrow_exception(this->Failure);
    }
  }

  vtkRenderWindowInteractor* Interactor() const { return this->Events; }
  const Camera& CurrentCamera() const { return this->Now; }

private:
  void BindKeys();
  void Press(const std::string& key);
  void Drag(int right, int up);
  void Go(double forward, double right, double up);
  void GoTo(std::size_t place);
  void Look();
  void FollowSize();
  void Poll();
  void Show(const ProgressiveView::Picture& picture);
  void Draw();

  ProgressiveView* View;
  std::string Title;
  std::vector<Camera> Places;
  Camera Now;
  double Step;
  ToneMappingSettings Tone;
  std::map<std::string, std::function<void()>> Keys; ///< by their names in X
  int Width = 0;                                     ///< of the pictures that are asked for
  int Height = 0;
  Image Shown;
  std::exception_ptr Failure;

  vtkNew<vtkRenderWindow> Window;
  vtkNew<vtkRenderer> Canvas;
  vtkNew<vtkImageActor> Actor;
  vtkNew<vtkRenderWindowInteractor> Events;
  vtkNew<WalkingStyle> Style;
};

void ViewWindow::Implementation::BindKeys()
{
  const auto bind = [this](std::initializer_list<const char*> keys, const auto& action)
  {
    for (const char* key : keys)
    {
      this->Keys[key] = action;
    }
  };
  bind({ "w", "Up" }, [this] { this->Go(1.0, 0.0, 0.0); });
  bind({ "s", "Down" }, [this] { this->Go(-1.0, 0.0, 0.0); });
  bind({ "d", "Right" }, [this] { this->Go(0.0, 1.0, 0.0); });
  bind({ "a", "Left" }, [this] { this->Go(0.0, -1.0, 0.0); });
  bind({ "Prior" }, [this] { this->Go(0.0, 0.0, 1.0); });
  bind({ "Next" }, [this] { this->Go(0.0, 0.0, -1.0); });
  for (std::size_t place = 0; place < 9; ++place)
  {
    this->Keys[std::to_string(place + 1)] = [this, place] { this->GoTo(place); };
  }
  const auto expose = [this](double exposure)
  {
    this->Tone.exposure = exposure;
    this->Draw();
  };
  bind({ "x" }, [this, expose] { expose(AutomaticExposure(this->Shown.pixels)); });
  bind({ "plus", "KP_Add" },
    [this, expose] { expose(this->Tone.exposure.value_or(0.0) + ExposureStep); });
  bind({ "minus", "KP_Subtract" },
    [this, expose] { expose(this->Tone.exposure.value_or(0.0) - ExposureStep); });
  bind({ "p" }, [this] { std::cout << PrintCamera(this->Now) << std::flush; });
  bind({ "q", "Escape" }, [this] { this->Events->TerminateApp(); });
}

void ViewWindow::Implementation::Press(const std::string& key)
{
  const auto found = this->Keys.find(key);
  if (found != this->Keys.end())
  {
    found->second();
  }
}

/// What is below the pointer stays there.
void ViewWindow::Implementation::Drag(int right, int up)
{
  const double anglePerPixel =
    this->Now.fieldOfView * Pi / 180.0 / std::max(1, this->Window->GetSize()[1]);
  this->Now = Turned(this->Now, -right * anglePerPixel, -up * anglePerPixel);
  this->Look();
}

void ViewWindow::Implementation::Go(double forward, double right, double up)
{
  this->Now = Moved(this->Now, forward * this->Step, right * this->Step, up * this->Step);
  this->Look();
}

void ViewWindow::Implementation::GoTo(std::size_t place)
{
  if (place < this->Places.size())
  {
    this->Now = this->Places[place];
    this->Look();
  }
}

void ViewWindow::Implementation::Look()
{
  const int* size = this->Window->GetSize();
  this->Width = std::max(1, size[0]);
  this->Height = std::max(1, size[1]);
  this->Now.aspect = static_cast<double>(this->Width) / this->Height;
  this->Window->SetWindowName((this->Title + " ...").c_str());
  this->View->LookFrom(this->Now, this->Width, this->Height);
}

void ViewWindow::Implementation::FollowSize()
{
  const int* size = this->Window->GetSize();
  if (size[0] != this->Width || size[1] != this->Height)
  {
    this->Look();
  }
}

void ViewWindow::Implementation::Poll()
{
  try
  {
    if (const auto picture = this->View->Take())
    {
      this->Show(*picture);
    }
  }
  catch (...)
  {
    // Not through the event loop, which is not ours.
    this->Failure = std::current_exception();
    this->Events->TerminateApp();
  }
}

void ViewWindow::Implementation::Show(const ProgressiveView::Picture& picture)
{
  this->Shown = picture.radiance;
  if (!this->Tone.exposure)
  {
    this->Tone.exposure = AutomaticExposure(this->Shown.pixels);
  }
  char state[96];
  std::snprintf(state, sizeof state, ": error %.2g %%, %zu interactions%s",
    100.0 * picture.errorEstimate, picture.interactions, picture.isLast ? "" : " ...");
  this->Window->SetWindowName((this->Title + state).c_str());
  this->Draw();
}

/// What is shown fills the window, whatever its pixels.
void ViewWindow::Implementation::Draw()
{
  const int width = this->Shown.width;
  const int height = this->Shown.height;
  if (this->Shown.pixels.empty())
  {
    return;
  }
  this->Actor->SetInputData(ScreenImage(ToneMap(this->Shown.pixels, this->Tone), width, height));
  this->Canvas->AddActor(this->Actor); // once: without a picture it is none
  vtkCamera* camera = this->Canvas->GetActiveCamera();
  const double middle[2] = { 0.5 * (width - 1), 0.5 * (height - 1) };
  camera->SetFocalPoint(middle[0], middle[1], 0.0);
  camera->SetPosition(middle[0], middle[1], 1.0);
  camera->SetParallelScale(0.5 * height);
  this->Canvas->ResetCameraClippingRange();
  this->Window->Render();
}

ViewWindow::ViewWindow(ProgressiveView& view, const Settings& settings)
  : Impl(std::make_unique<Implementation>(view, settings))
{
}

ViewWindow::~ViewWindow() = default;

void ViewWindow::Run()
{
  this->Impl->Run();
}

vtkRenderWindowInteractor* ViewWindow::Interactor() const
{
  return this->Impl->Interactor();
}

const Camera& ViewWindow::CurrentCamera() const
{
  return this->Impl->CurrentCamera();
}

} // namespace vantage
