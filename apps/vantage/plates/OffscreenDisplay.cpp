#include "plates/OffscreenDisplay.h"

#include "core/Error.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <algorithm>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkRenderer.h>
#include <vtkWindowToImageFilter.h>

namespace vantage
{

namespace
{

/// A window in whichever OpenGL context is current.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static SurfacelessWindow* New();
  vtkTypeMacro(SurfacelessWindow, vtkGenericOpenGLRenderWindow)

  /// GLEW, when it is built for X, finds all functions of OpenGL and then complains that there is
  /// no X display. None is needed, so the complaint is not passed on.
  void OpenGLInitContext() override
  {
    const int areWarningsOn = vtkObject::GetGlobalWarningDisplay();
    vtkObject::GlobalWarningDisplayOff();
    this->Superclass::OpenGLInitContext();
    vtkObject::SetGlobalWarningDisplay(areWarningsOn);
    this->Initialized = true;
    this->GlewInitValid = true;
  }

protected:
  SurfacelessWindow()
  {
    this->SetIsDirect(1);
    this->SetSupportsOpenGL(1);
    this->SetIsCurrent(true);
    this->SetMapped(1);
    this->SetUseOffScreenBuffers(true);
    this->SetShowWindow(false);
  }
};

vtkStandardNewMacro(SurfacelessWindow)

} // namespace

/// An OpenGL context that is current in this thread and needs no surface.
struct OffscreenDisplay::Context
{
  Context()
  {
    // Mesa's software and hardware drivers know the first kind, others may know the second.
    if (!this->Open(
          eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)) &&
        !this->Open(eglGetDisplay(EGL_DEFAULT_DISPLAY)))
    {
      throw Error("drawing: EGL finds no OpenGL 3.2 to draw with; install libegl1 and "
                  "libgl1-mesa-dri");
    }
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { this->Close(); }

  bool Open(EGLDisplay display)
  {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
    {
      return false;
    }
    this->Display = display;
    const EGLint configAttributes[] = { EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
      EGL_NONE };
    const EGLint contextAttributes[] = { EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
      EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (eglBindAPI(EGL_OPENGL_API) == EGL_TRUE &&
        eglChooseConfig(display, configAttributes, &config, 1, &count) == EGL_TRUE && count == 1)
    {
      this->Handle = eglCreateContext(display, config, EGL_NO_CONTEXT, contextAttributes);
    }
    if (this->Handle != EGL_NO_CONTEXT &&
        eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, this->Handle) == EGL_TRUE)
    {
      return true;
    }
    this->Close();
    return false;
  }

  void Close()
  {
    if (this->Display != EGL_NO_DISPLAY)
    {
      eglMakeCurrent(this->Display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
      eglTerminate(this->Display); // with all its contexts
      eglReleaseThread();
    }
    this->Display = EGL_NO_DISPLAY;
    this->Handle = EGL_NO_CONTEXT;
  }

  EGLDisplay Display = EGL_NO_DISPLAY;
  EGLContext Handle = EGL_NO_CONTEXT;
};

OffscreenDisplay::OffscreenDisplay()
  : Egl(std::make_unique<Context>())
  , Window(vtkSmartPointer<SurfacelessWindow>::New())
{
  this->Window->SetMultiSamples(4);
}

OffscreenDisplay::~OffscreenDisplay()
{
  this->Window->Finalize(); // while there is a context
}

vtkSmartPointer<vtkImageData> OffscreenDisplay::Draw(
  const std::vector<vtkRenderer*>& renderers, int width, int height)
{
  this->Window->SetSize(Supersampling * width, Supersampling * height);
  int layers = 1;
  for (vtkRenderer* renderer : renderers)
  {
    layers = std::max(layers, renderer->GetLayer() + 1);
    this->Window->AddRenderer(renderer);
  }
  this->Window->SetNumberOfLayers(layers);
  this->Window->Render();

  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(this->Window);
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  vtkNew<vtkImageShrink3D> average;
  average->SetInputConnection(grab->GetOutputPort());
  average->SetShrinkFactors(Supersampling, Supersampling, 1);
  average->AveragingOn();
  average->Update();
  for (vtkRenderer* renderer : renderers)
  {
    this->Window->RemoveRenderer(renderer);
  }
  return average->GetOutput();
}

} // namespace vantage
