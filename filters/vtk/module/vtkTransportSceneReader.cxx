#include "vtkTransportSceneReader.h"

#include "SceneAdapter.h"
#include "core/Error.h"
#include "io/ObjFile.h"

#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtksys/SystemTools.hxx>

vtkStandardNewMacro(vtkTransportSceneReader);

namespace
{

/// Keeps what the file has beside the scene; the scene's own arrays replace those of their names.
void KeepOtherArrays(vtkPolyData* file, vtkPolyData* polygons)
{
  const vtkIdType count = polygons->GetNumberOfCells();
  vtkNew<vtkCellData> cellData;
  cellData->CopyAllOn();
  cellData->CopyAllocate(file->GetCellData(), count);
  cellData->CopyData(
    file->GetCellData(), 0, count, static_cast<vtkIdType>(vantage::FirstPolygonCell(file)));
  for (int k = 0; k < polygons->GetCellData()->GetNumberOfArrays(); ++k)
  {
    cellData->AddArray(polygons->GetCellData()->GetAbstractArray(k));
  }
  polygons->GetCellData()->ShallowCopy(cellData);
  polygons->GetPointData()->ShallowCopy(file->GetPointData());
  for (int k = 0; k < file->GetFieldData()->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* array = file->GetFieldData()->GetAbstractArray(k);
    if (polygons->GetFieldData()->HasArray(array->GetName()) == 0)
    {
      polygons->GetFieldData()->AddArray(array);
    }
  }
}

vtkSmartPointer<vtkPolyData> ReadObjFile(
  const std::string& fileName, std::vector<std::string>& warnings)
{
  const vantage::Scene scene = vantage::ReadObj(fileName, &warnings);
  scene.Validate();
  return vantage::SceneToPolyData(scene);
}

vtkSmartPointer<vtkPolyData> ReadPolygons(const std::string& fileName)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  bool hasFailed = false;
  // One line of ours says it; reader, parser and executive would each print a paragraph.
  vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&hasFailed);
  observer->SetCallback(
    [](vtkObject*, unsigned long, void* flag, void*) { *static_cast<bool*>(flag) = true; });
  reader->SetReaderErrorObserver(observer);
  reader->SetParserErrorObserver(observer);
  reader->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, observer);
  reader->SetFileName(fileName.c_str());
  reader->Update();
  if (hasFailed || reader->GetErrorCode() != 0)
  {
    throw vantage::InputError(
      fileName + ": not a readable VTK polygon file (.vtp); write it again");
  }
  return reader->GetOutput();
}

vtkSmartPointer<vtkPolyData> ReadVtpFile(const std::string& fileName)
{
  const auto file = ReadPolygons(fileName);
  try
  {
    const vantage::Scene scene = vantage::PolyDataToScene(file);
    scene.Validate();
    auto polygons = vantage::SceneToPolyData(scene);
    KeepOtherArrays(file, polygons);
    return polygons;
  }
  catch (const vantage::InputError& error)
  {
    throw vantage::InputError(fileName + ": " + error.what());
  }
}

vtkSmartPointer<vtkPolyData> ReadFile(
  const std::string& fileName, std::vector<std::string>& warnings)
{
  if (fileName.empty())
  {
    throw vantage::InputError("FileName is empty; set it to an .obj or .vtp file");
  }
  if (!vtksys::SystemTools::FileExists(fileName, true))
  {
    throw vantage::InputError(fileName + ": no such file; check FileName");
  }
  const std::string suffix =
    vtksys::SystemTools::LowerCase(vtksys::SystemTools::GetFilenameLastExtension(fileName));
  if (suffix == ".obj")
  {
    return ReadObjFile(fileName, warnings);
  }
  if (suffix == ".vtp")
  {
    return ReadVtpFile(fileName);
  }
  throw vantage::UnknownNameError("suffix of a scene file", fileName, ".obj, .vtp");
}

} // namespace

vtkTransportSceneReader::vtkTransportSceneReader()
{
  this->SetNumberOfInputPorts(0);
}

vtkTransportSceneReader::~vtkTransportSceneReader() = default;

int vtkTransportSceneReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  try
  {
    std::vector<std::string> warnings;
    vtkPolyData::GetData(outputVector)->ShallowCopy(ReadFile(this->FileName, warnings));
    for (const std::string& warning : warnings)
    {
      vtkWarningMacro(<< warning);
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkTransportSceneReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}
