#include "vtkRadianceToneMapping.h"

#include "ErrorRecorder.h"
#include "SceneAdapter.h"
#include "TestScenes.h"
#include "core/view/ToneMapping.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <gtest/gtest.h>

#include <limits>

namespace vantage
{
namespace
{

/// A 2 x 2 image with these radiances.
vtkSmartPointer<vtkImageData> MakeImage(const std::vector<Color>& radiance)
{
  vtkNew<vtkFloatArray> array;
  array->SetName("Radiance");
  array->SetNumberOfComponents(3);
  for (const Color& color : radiance)
  {
    array->InsertNextTuple(&color.x);
  }
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(2, 2, 1);
  image->GetPointData()->AddArray(array);
  return image;
}

ScreenColor ColorAt(vtkDataSetAttributes* attributes, vtkIdType k)
{
  ScreenColor color{};
  const auto array = vtkUnsignedCharArray::SafeDownCast(attributes->GetArray("RGB"));
  if (!array || array->GetNumberOfComponents() != 3)
  {
    ADD_FAILURE() << "no RGB of three unsigned char";
    return color;
  }
  array->GetTypedTuple(k, color.data());
  return color;
}

// Exact in single precision, which the image holds.
const std::vector<Color> Radiances{ Color(0.25, 0.5, 1.0), Color(2.0), Color(0.0),
  Color(8.0, 4, 2) };

TEST(RadianceToneMapping, AnImageIsMappedAsTheCoreDoes)
{
  vtkNew<vtkRadianceToneMapping> filter;
  filter->SetInputData(MakeImage(Radiances));
  filter->Update();
  const std::vector<ScreenColor> expected = ToneMap(Radiances);
  for (vtkIdType k = 0; k < 4; ++k)
  {
    EXPECT_EQ(ColorAt(filter->GetOutput()->GetPointData(), k), expected[k]);
  }
  EXPECT_STREQ(filter->GetOutput()->GetPointData()->GetScalars()->GetName(), "RGB");
  EXPECT_TRUE(filter->GetOutput()->GetPointData()->HasArray("Radiance"));
}

TEST(RadianceToneMapping, GivenExposureAndWhiteAreUsed)
{
  vtkNew<vtkRadianceToneMapping> filter;
  filter->SetInputData(MakeImage(Radiances));
  filter->AutomaticExposureOff();
  filter->SetExposure(-1.5);
  filter->SetWhite(2.0);
  filter->Update();
  ToneMappingSettings settings;
  settings.exposure = -1.5;
  settings.white = 2.0;
  const std::vector<ScreenColor> expected = ToneMap(Radiances, settings);
  for (vtkIdType k = 0; k < 4; ++k)
  {
    EXPECT_EQ(ColorAt(filter->GetOutput()->GetPointData(), k), expected[k]);
  }
}

TEST(RadianceToneMapping, CellsAndPointsShareTheExposureOfTheCells)
{
  const auto polygons = SceneToPolyData(MakeLitBox());
  vtkNew<vtkDoubleArray> cells, points;
  for (vtkDoubleArray* array : { cells.Get(), points.Get() })
  {
    array->SetName("Radiance"); // one component: grey
    array->SetNumberOfTuples(
      array == cells.Get() ? polygons->GetNumberOfCells() : polygons->GetNumberOfPoints());
    array->Fill(array == cells.Get() ? 3.0 : 30.0);
  }
  points->SetValue(0, 3.0);
  polygons->GetCellData()->AddArray(cells);
  polygons->GetPointData()->AddArray(points);
  vtkNew<vtkRadianceToneMapping> filter;
  filter->SetInputData(polygons);
  filter->Update();
  vtkDataSet* output = filter->GetOutput();
  EXPECT_EQ(ColorAt(output->GetCellData(), 0), ColorAt(output->GetPointData(), 0));
  EXPECT_LT(ColorAt(output->GetCellData(), 0)[0], ColorAt(output->GetPointData(), 1)[0]);
  EXPECT_EQ(ColorAt(output->GetCellData(), 0), ToneMap({ Color(3.0) })[0]);
}

TEST(RadianceToneMapping, TheInputIsLeftAlone)
{
  const auto image = MakeImage(Radiances);
  vtkNew<vtkRadianceToneMapping> filter;
  filter->SetInputData(image);
  filter->Update();
  EXPECT_EQ(image->GetPointData()->GetNumberOfArrays(), 1);
}

TEST(RadianceToneMapping, WhatItCannotMapIsAnError)
{
  vtkNew<vtkRadianceToneMapping> filter;
  ErrorRecorder recorder(filter);
  ErrorRecorder executive(filter->GetExecutive());
  filter->SetInputData(MakeImage(Radiances));
  const auto errorOf = [&]
  {
    filter->Update();
    return recorder.Take();
  };
  filter->SetArrayName("Luminance");
  EXPECT_NE(errorOf().find("'Luminance'"), std::string::npos);
  EXPECT_FALSE(filter->GetOutput()->GetPointData()->HasArray("RGB"));
  filter->SetArrayName("Radiance");
  EXPECT_EQ(errorOf(), "");
  for (const double bad : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN() })
  {
    filter->SetWhite(bad);
    EXPECT_NE(errorOf().find("white"), std::string::npos);
  }
  filter->SetWhite(4.0);
  filter->AutomaticExposureOff();
  filter->SetExposure(std::numeric_limits<double>::infinity());
  EXPECT_NE(errorOf().find("exposure"), std::string::npos);
  filter->AutomaticExposureOn();

  const auto twoComponents = MakeImage(Radiances);
  twoComponents->GetPointData()->GetArray("Radiance")->SetNumberOfComponents(2);
  twoComponents->GetPointData()->GetArray("Radiance")->SetNumberOfTuples(4);
  filter->SetInputData(twoComponents);
  EXPECT_NE(errorOf().find("2 components"), std::string::npos);
}

} // namespace
} // namespace vantage
