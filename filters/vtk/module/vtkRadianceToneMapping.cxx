#include "vtkRadianceToneMapping.h"

#include "core/Error.h"
#include "core/view/ToneMapping.h"

#include <vtkCellData.h>
#include <vtkDataSet.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

vtkStandardNewMacro(vtkRadianceToneMapping);

namespace
{

std::vector<vantage::Color> ArrayToColors(vtkDataArray* array)
{
  const int components = array->GetNumberOfComponents();
  if (components != 1 && components != 3)
  {
    throw vantage::InputError(std::string("array ") + array->GetName() + " has " +
                              std::to_string(components) + " components; give 3, or 1 for grey");
  }
  std::vector<vantage::Color> colors(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < colors.size(); ++k)
  {
    const auto tuple = static_cast<vtkIdType>(k);
    for (int channel = 0; channel < 3; ++channel)
    {
      colors[k][channel] = array->GetComponent(tuple, components == 3 ? channel : 0);
    }
  }
  return colors;
}

vtkSmartPointer<vtkUnsignedCharArray> ScreenColorsToArray(
  const std::vector<vantage::ScreenColor>& colors)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName("RGB");
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(colors.size()));
  for (std::size_t k = 0; k < colors.size(); ++k)
  {
    array->SetTypedTuple(static_cast<vtkIdType>(k), colors[k].data());
  }
  return array;
}

} // namespace

vtkRadianceToneMapping::vtkRadianceToneMapping()
  : White(vantage::ToneMappingSettings().white)
{
}

vtkRadianceToneMapping::~vtkRadianceToneMapping() = default;

void vtkRadianceToneMapping::MapArrays(vtkDataSet* output) const
{
  vantage::ToneMappingSettings settings;
  settings.white = this->White;
  if (!this->AutomaticExposure)
  {
    settings.exposure = this->Exposure;
  }
  settings.Validate();

  bool found = false;
  // Cells first: their exposure is the one that points then share.
  for (vtkDataSetAttributes* attributes :
    { static_cast<vtkDataSetAttributes*>(output->GetCellData()),
      static_cast<vtkDataSetAttributes*>(output->GetPointData()) })
  {
    vtkDataArray* array = attributes->GetArray(this->ArrayName.c_str());
    if (!array)
    {
      continue;
    }
    found = true;
    const std::vector<vantage::Color> radiance = ArrayToColors(array);
    if (!settings.exposure)
    {
      settings.exposure = vantage::AutomaticExposure(radiance);
    }
    attributes->AddArray(ScreenColorsToArray(vantage::ToneMap(radiance, settings)));
    attributes->SetActiveScalars("RGB");
  }
  if (!found)
  {
    throw vantage::InputError("the input has no point or cell array of numbers '" +
                              this->ArrayName + "'; set ArrayName to one that it has");
  }
}

/// Filters that make images of images ask for their scalars before there are any.
int vtkRadianceToneMapping::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  if (vtkImageData::GetData(info))
  {
    vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_UNSIGNED_CHAR, 3);
  }
  return 1;
}

int vtkRadianceToneMapping::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* output = vtkDataSet::GetData(outputVector);
  output->ShallowCopy(vtkDataSet::GetData(inputVector[0]));
  try
  {
    this->MapArrays(output);
    return 1;
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkRadianceToneMapping::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "ArrayName: " << this->ArrayName << "\n";
  os << indent << "AutomaticExposure: " << (this->AutomaticExposure ? "on" : "off") << "\n";
  os << indent << "Exposure: " << this->Exposure << "\n";
  os << indent << "White: " << this->White << "\n";
}
