#include "view/ProgressiveView.h"

#include "Rooms.h"
#include "core/Error.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>
#include <vector>

namespace vantage
{
namespace
{

using test::MakeRooms;

using Picture = ProgressiveView::Picture;

/// All pictures up to the last of a camera; fewer after a minute.
std::vector<Picture> TakeAll(ProgressiveView& view)
{
  std::vector<Picture> pictures;
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while ((pictures.empty() || !pictures.back().isLast) && std::chrono::steady_clock::now() < end)
  {
    if (auto picture = view.Take())
    {
      pictures.push_back(std::move(*picture));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return pictures;
}

Image DrawAfresh(const Scene& scene, const Camera& camera, int size, double error)
{
  Solver solver(scene);
  solver.SetCamera(camera);
  Budget budget;
  budget.error = error;
  solver.Run(budget);
  GatherSettings settings;
  settings.width = size;
  settings.height = size;
  settings.error = GatherShare * error;
  return solver.Gather(camera, settings).radiance;
}

Camera Square(Camera camera)
{
  camera.aspect = 1.0;
  return camera;
}

TEST(ProgressiveView, GetsBetterUntilItIsAsGoodAsAskedFor)
{
  const Scene scene = MakeRooms();
  ProgressiveView view(scene, {}, 0.03);
  EXPECT_FALSE(view.Take());
  const Camera camera = Square(scene.cameras[0]);
  view.LookFrom(camera, 64, 64);
  const std::vector<Picture> pictures = TakeAll(view);
  ASSERT_FALSE(pictures.empty());
  double last = std::numeric_limits<double>::infinity();
  for (const Picture& picture : pictures)
  {
    EXPECT_LT(picture.errorEstimate, last);
    EXPECT_GT(picture.interactions, 0u);
    last = picture.errorEstimate;
  }
  ASSERT_TRUE(pictures.back().isLast);
  EXPECT_LE(pictures.back().errorEstimate, 0.03);
  ASSERT_EQ(pictures.back().radiance.width, 64);
  ASSERT_EQ(pictures.back().radiance.height, 64);
  // Both may be wrong by what was asked.
  const Image afresh = DrawAfresh(scene, camera, 64, 0.03);
  EXPECT_LT(Compare(pictures.back().radiance, afresh).relativeL1, 0.06);
}

TEST(ProgressiveView, FollowsTheCamera)
{
  const Scene scene = MakeRooms();
  ASSERT_GE(scene.cameras.size(), 2u);
  ProgressiveView view(scene, {}, 0.05);
  // All but the last are given up somewhere on the way.
  for (int i = 0; i < 20; ++i)
  {
    view.LookFrom(Square(scene.cameras[i % 2]), 48, 48);
    std::this_thread::sleep_for(std::chrono::milliseconds(i));
  }
  const Camera there = Square(scene.cameras[1]);
  Image shown;
  const Image expected = DrawAfresh(scene, there, 48, 0.05);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  while (std::chrono::steady_clock::now() < end &&
         (shown.width != 48 || Compare(shown, expected).relativeL1 > 0.1))
  {
    const std::vector<Picture> pictures = TakeAll(view);
    ASSERT_FALSE(pictures.empty());
    shown = pictures.back().radiance;
  }
  EXPECT_LT(Compare(shown, expected).relativeL1, 0.1); // both may be wrong by what was asked
}

TEST(ProgressiveView, ShowsSomethingHoweverFastTheCameraMoves)
{
  const Scene scene = MakeRooms();
  for (const double error : { 0.0005, 0.5 }) // with coarser pictures before the last, and without
  {
    ProgressiveView view(scene, {}, error);
    int pictures = 0;
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    for (int i = 0; pictures < 3 && std::chrono::steady_clock::now() < end; ++i)
    {
      view.LookFrom(Square(scene.cameras[i % 2]), 48, 48);
      pictures += view.Take() ? 1 : 0;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(pictures, 3) << error;
  }
}

TEST(ProgressiveView, MayEndAtAnyTime)
{
  const Scene scene = MakeRooms();
  for (int i = 0; i < 10; ++i)
  {
    ProgressiveView view(scene, {}, 0.0005);
    if (i > 0)
    {
      view.LookFrom(Square(scene.cameras[0]), 128, 128);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * i));
  }
}

TEST(ProgressiveView, TellsWhatIsWrong)
{
  Scene scene = MakeRooms();
  scene.materials[0].albedo = Color(1.5);
  ProgressiveView view(scene, {}, 0.05);
  const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
  bool isThrown = false;
  while (!isThrown && std::chrono::steady_clock::now() < end)
  {
    try
    {
      view.Take();
    }
    catch (const InputError&)
    {
      isThrown = true;
    }
  }
  EXPECT_TRUE(isThrown);
}

} // namespace
} // namespace vantage
