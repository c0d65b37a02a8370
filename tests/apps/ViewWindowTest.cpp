#include "view/ViewWindow.h"

#include "Rooms.h"
#include "core/Error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>
#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkUnsignedCharArray.h>

namespace vantage
{
namespace
{

using test::MakeRooms;

constexpr int Size = 96;

/// A window on the scene, and somebody in front of it.
class Session
{
public:
  explicit Session(const Scene& scene, double error = 0.1)
    : View(scene, {}, error)
    , Window(this->View, SettingsFor(scene))
  {
  }

  /// What is done once pictures of this camera are done, in turn; then the window is closed.
  void Do(std::vector<std::function<void()>> deeds)
  {
    this->Deeds = std::move(deeds);
    vtkNew<vtkCallbackCommand> tick;
    tick->SetClientData(this);
    tick->SetCallback(
      [](vtkObject*, unsigned long, void* self, void*) { static_cast<Session*>(self)->Tick(); });
    this->Events()->AddObserver(vtkCommand::TimerEvent, tick);
    this->Window.Run();
  }

  void Press(const char* key)
  {
    this->Events()->SetKeyEventInformation(0, 0, 0, 1, key);
    this->Events()->InvokeEvent(vtkCommand::KeyPressEvent);
  }
  void Drag(int right, int up)
  {
    this->Events()->SetEventInformation(40, 40);
    this->Events()->InvokeEvent(vtkCommand::LeftButtonPressEvent);
    this->Events()->SetEventInformation(40 + right, 40 + up);
    this->Events()->InvokeEvent(vtkCommand::MouseMoveEvent);
    this->Events()->InvokeEvent(vtkCommand::LeftButtonReleaseEvent);
    this->Events()->SetEventInformation(80, 80);
    this->Events()->InvokeEvent(vtkCommand::MouseMoveEvent); // drags nothing any more
  }
  vtkRenderWindowInteractor* Events() { return this->Window.Interactor(); }
  const Camera& Now() const { return this->Window.CurrentCamera(); }
  std::string Title() { return this->Events()->GetRenderWindow()->GetWindowName(); }
  /// Mean of what the window shows, of 255.
  double Brightness()
  {
    vtkNew<vtkUnsignedCharArray> pixels;
    vtkRenderWindow* window = this->Events()->GetRenderWindow();
    window->GetPixelData(0, 0, window->GetSize()[0] - 1, window->GetSize()[1] - 1, 1, pixels);
    double sum = 0.0;
    for (vtkIdType i = 0; i < pixels->GetNumberOfValues(); ++i)
    {
      sum += pixels->GetValue(i);
    }
    return sum / static_cast<double>(pixels->GetNumberOfValues());
  }
  bool IsLate() const { return this->WasLate; }

private:
  static ViewWindow::Settings SettingsFor(const Scene& scene)
  {
    ViewWindow::Settings settings;
    settings.title = "rooms";
    settings.start = scene.cameras[0];
    settings.width = Size;
    settings.height = Size;
    settings.places = scene.cameras;
    return settings;
  }

  void Tick()
  {
    this->WasLate = std::chrono::steady_clock::now() > this->End;
    const std::string title = this->Title();
    const bool isDone =
      title.find("interactions") != std::string::npos && title.find("...") == std::string::npos;
    if (isDone && this->Next < this->Deeds.size())
    {
      this->Deeds[this->Next++]();
    }
    else if (isDone || this->WasLate)
    {
      this->Events()->TerminateApp();
    }
  }

  ProgressiveView View;
  ViewWindow Window;
  std::vector<std::function<void()>> Deeds;
  std::size_t Next = 0;
  std::chrono::steady_clock::time_point End =
    std::chrono::steady_clock::now() + std::chrono::minutes(2);
  bool WasLate = false;
};

TEST(ViewWindow, ShowsThePictureAndSaysHowGoodItIs)
{
  Session session(MakeRooms());
  double shown = 0.0;
  session.Do({ [&] { shown = session.Brightness(); } });
  EXPECT_FALSE(session.IsLate());
  // Middle grey is 118 of 255 where light is even.
  EXPECT_GT(shown, 60.0);
  EXPECT_LT(shown, 190.0);
  const std::string title = session.Title();
  EXPECT_EQ(title.rfind("rooms: error ", 0), 0u) << title;
}

TEST(ViewWindow, WalksWithKeysAndWheel)
{
  const Scene scene = MakeRooms();
  Session session(scene);
  std::vector<Camera> seen;
  const auto note = [&] { seen.push_back(session.Now()); };
  session.Do({ [&]
    {
      note();
      session.Press("w");
      note();
      session.Press("s");
      note();
    },
    [&]
    {
      session.Press("d");
      note();
      session.Press("a");
      session.Press("Prior");
      note();
    },
    [&]
    {
      session.Press("2");
      note();
      session.Press("9");
      note();
    },
    [&]
    {
      session.Events()->InvokeEvent(vtkCommand::MouseWheelForwardEvent);
      note();
    } });
  ASSERT_FALSE(session.IsLate());
  ASSERT_EQ(seen.size(), 8u);
  const Vec3 ahead = glm::normalize(seen[0].lookAt - seen[0].eye);
  const double step = glm::distance(seen[1].eye, seen[0].eye);
  EXPECT_NEAR(glm::dot(seen[1].eye - seen[0].eye, ahead), step, 1e-12);
  EXPECT_NEAR(step, 0.05 * glm::distance(seen[0].lookAt, seen[0].eye), 1e-12);
  EXPECT_LT(glm::distance(seen[2].eye, seen[0].eye), 1e-12);
  EXPECT_NEAR(glm::dot(seen[3].eye - seen[0].eye, ahead), 0.0, 1e-12);
  EXPECT_NEAR(seen[4].eye.z - seen[0].eye.z, step, 1e-12);
  EXPECT_EQ(seen[5].eye, scene.cameras[1].eye);
  EXPECT_EQ(seen[6].eye, scene.cameras[1].eye); // there is no ninth camera
  EXPECT_NEAR(glm::distance(seen[7].eye, scene.cameras[1].eye), step, 1e-12);
}

TEST(ViewWindow, LooksAroundWhenItIsDragged)
{
  const Scene scene = MakeRooms();
  Session session(scene);
  Camera before;
  Camera after;
  session.Do({ [&]
    {
      before = session.Now();
      session.Drag(Size / 4, 0);
      after = session.Now();
    } });
  ASSERT_FALSE(session.IsLate());
  EXPECT_EQ(after.eye, before.eye);
  // What was at the pointer comes along: a quarter of the window is a quarter of the view.
  const Vec3 a = before.lookAt - before.eye;
  const Vec3 b = after.lookAt - after.eye;
  const double turn = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  EXPECT_NEAR(turn, 0.25 * before.fieldOfView * Pi / 180.0, 1e-9);
}

TEST(ViewWindow, ExposesAsItIsTold)
{
  Session session(MakeRooms());
  std::vector<double> seen;
  const auto note = [&] { seen.push_back(session.Brightness()); };
  session.Do({ [&]
    {
      note();
      session.Press("minus");
      session.Press("minus");
      note();
      session.Press("plus");
      note();
      session.Press("x");
      note();
    } });
  ASSERT_FALSE(session.IsLate());
  ASSERT_EQ(seen.size(), 4u);
  EXPECT_LT(seen[1], seen[0] - 5.0);
  EXPECT_GT(seen[2], seen[1] + 2.0);
  EXPECT_NEAR(seen[3], seen[0], 10.0); // of the first picture, and of the last
}

TEST(ViewWindow, PrintsTheCameraAndCloses)
{
  Session session(MakeRooms());
  testing::internal::CaptureStdout();
  session.Do({ [&]
    {
      session.Press("p");
      session.Press("q");
    },
    [] { FAIL() << "it is still there"; } });
  const std::string printed = testing::internal::GetCapturedStdout();
  EXPECT_EQ(printed.rfind("# camera view1 eye ", 0), 0u) << printed;
}

TEST(ViewWindow, FollowsItsSize)
{
  Session session(MakeRooms());
  session.Do({ [&]
    {
      session.Events()->GetRenderWindow()->SetSize(2 * Size, Size);
      session.Events()->InvokeEvent(vtkCommand::ConfigureEvent);
    } });
  EXPECT_FALSE(session.IsLate());
  EXPECT_DOUBLE_EQ(session.Now().aspect, 2.0);
}

TEST(ViewWindow, PassesOnWhatIsWrong)
{
  Scene scene = MakeRooms();
  scene.materials[0].albedo = Color(1.5);
  Session session(scene);
  EXPECT_THROW(session.Do({}), InputError);
}

} // namespace
} // namespace vantage
