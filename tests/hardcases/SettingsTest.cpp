#include "core/scene/Labyrinth.h"
#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <functional>

namespace vantage
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/// Sets a number somewhere, and uses it.
using Setter = std::function<void(double)>;

void ExpectRefused(const std::vector<double>& values, const std::vector<Setter>& setters)
{
  for (std::size_t k = 0; k < setters.size(); ++k)
  {
    for (const double value : values)
    {
      EXPECT_THROW(setters[k](value), InputError) << "setter " << k << ", value " << value;
    }
  }
}

Setter Setting(double RefinementSettings::*member)
{
  return [member](double value)
  {
    SolverSettings settings;
    settings.refinement.*member = value;
    Solver(test::MakeLitBox(), settings);
  };
}

/// What no field can be. Fields of Scene and Camera: SceneTest, CameraTest.
TEST(HardCase, SettingsThatAreNoNumbersAreRefused)
{
  const Scene scene = test::MakeLitBox();
  Solver solver(scene);
  solver.SetCamera(scene.cameras[0]);
  Budget budget;
  budget.steps = 1;
  solver.Run(budget);
  const std::vector<Setter> setters = {
    Setting(&RefinementSettings::formFactorTolerance),
    Setting(&RefinementSettings::powerTolerance),
    Setting(&RefinementSettings::shadowTolerance),
    Setting(&RefinementSettings::minimumElementSize),
    [&](double value) {
      solver.Run({ 1, 1.0, value });
    },
    [&](double value) { solver.GatherElements(scene.cameras[0], value); },
    [&](double value)
    {
      GatherSettings settings;
      settings.error = value;
      solver.Gather(scene.cameras[0], settings);
    },
    [&](double value)
    {
      Camera camera = scene.cameras[0];
      camera.eye.y = value;
      camera.fieldOfView = value;
      solver.SetCamera(camera);
    },
    [&](double value)
    {
      std::vector<Material> materials = scene.materials;
      materials[0].emission.z = value;
      solver.SetMaterials(materials);
    },
    [](double value) {
      MakeLabyrinth({ 1, 1, 1, value });
    },
    [](double value) {
      MakeLabyrinth({ 1, 1, 1, 0.5, value });
    },
    [](double value) {
      MakeLabyrinth({ 1, 1, 1, 0.5, 0.5, value });
    },
    [](double value) { BuildFacets(test::MakeLitBox(), value); },
  };
  ExpectRefused({ NotANumber, Infinity, -Infinity, -1.0 }, setters);
  // A time may be endless, but not this.
  ExpectRefused({ NotANumber, -Infinity, 0.0 }, { [&](double value) {
    solver.Run({ 1, value });
  } });
  // Nothing of it has changed the solver.
  EXPECT_EQ(solver.History().size(), 1u);
  EXPECT_EQ(solver.GetScene().materials[0].emission, scene.materials[0].emission);
}

/// Oracle: light adds up. All that a lamp of any brightness may be gives the same picture.
TEST(HardCase, LampsOfAnyBrightness)
{
  const Image expected = test::CasePicture(test::MakeLitBox(), 0.05);
  for (const double scale : { 1e-98, 1e98 })
  {
    Scene scene = test::MakeLitBox();
    for (Material& material : scene.materials)
    {
      material.emission *= scale;
    }
    Image found = test::CasePicture(scene, 0.05);
    for (Color& pixel : found.pixels)
    {
      pixel /= scale;
    }
    EXPECT_LT(Compare(found, expected).relativeL1, 1e-9) << scale; // round-off
  }
}

/// Surfaces that reflect next to nothing, less than a number can be told from zero by dividing.
TEST(HardCase, AlbedosThatAreDenormal)
{
  Scene scene = test::MakeFurnace(Color(5e-324, 1e-310, 1e-300), Color(2.0));
  for (const Color& pixel : test::CasePicture(scene, 0.01).pixels)
  {
    ASSERT_EQ(pixel, Color(2.0));
  }
}

} // namespace
} // namespace vantage
