#include "vtkTransportSolution.h"

#include "SolvedView.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkTransportSolution);

vtkTransportSolution::vtkTransportSolution() = default;
vtkTransportSolution::~vtkTransportSolution() = default;

void vtkTransportSolution::Initialize()
{
  this->Superclass::Initialize();
  this->View.reset();
}

void vtkTransportSolution::Share(vtkDataObject* source)
{
  const auto* other = vtkTransportSolution::SafeDownCast(source);
  this->View = other ? other->View : nullptr;
}

void vtkTransportSolution::ShallowCopy(vtkDataObject* source)
{
  this->Superclass::ShallowCopy(source);
  this->Share(source);
}

void vtkTransportSolution::DeepCopy(vtkDataObject* source)
{
  this->Superclass::DeepCopy(source);
  this->Share(source);
}

unsigned long vtkTransportSolution::GetActualMemorySize()
{
  const std::size_t bytes = this->View ? this->View->Bytes() : 0;
  return this->Superclass::GetActualMemorySize() +
         static_cast<unsigned long>((bytes + 1023) / 1024);
}

void vtkTransportSolution::SetView(std::shared_ptr<const vantage::SolvedView> view)
{
  this->View = std::move(view);
  this->Modified();
}

vtkTransportSolution* vtkTransportSolution::GetData(vtkInformation* info)
{
  return info ? vtkTransportSolution::SafeDownCast(info->Get(vtkDataObject::DATA_OBJECT()))
              : nullptr;
}

vtkTransportSolution* vtkTransportSolution::GetData(vtkInformationVector* vector, int index)
{
  return vtkTransportSolution::GetData(vector->GetInformationObject(index));
}

void vtkTransportSolution::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Solution: " << (this->View ? "" : "(none)") << "\n";
  if (this->View)
  {
    const vtkIndent next = indent.GetNextIndent();
    const vantage::Camera& camera = this->View->camera;
    const auto print = [&](const char* name, const vantage::Vec3& v)
    { os << next << name << ": (" << v.x << ", " << v.y << ", " << v.z << ")\n"; };
    os << next << "Elements: " << this->View->nodeOfCell.size() << "\n";
    os << next << "ErrorEstimate: " << this->View->errorEstimate << "\n";
    os << next << "CameraName: " << camera.name << "\n";
    print("EyePosition", camera.eye);
    print("FocalPoint", camera.lookAt);
    print("ViewUp", camera.up);
    os << next << "ViewAngle: " << camera.fieldOfView << "\n";
  }
}
