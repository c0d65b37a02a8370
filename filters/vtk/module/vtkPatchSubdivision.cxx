#include "vtkPatchSubdivision.h"

#include "ArrayAdapter.h"
#include "SceneAdapter.h"
#include "core/Error.h"
#include "core/mesh/LongestEdge.h"
#include "core/mesh/PatchMesh.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <sstream>

vtkStandardNewMacro(vtkPatchSubdivision);

namespace
{

constexpr double LargestPatchCount = 134217728.0; // 2^27: tens of gigabytes of output

/// Every split halves the edges, so the count is known, closely, before the first one.
void CheckPatchCount(const vantage::ElementTree& tree, double maximumEdgeLength)
{
  double count = 0.0;
  for (vantage::NodeId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster())
    {
      const double splits =
        std::ceil(std::log2(vantage::LongestEdge(tree[id]) / maximumEdgeLength));
      count += std::pow(4.0, std::max(0.0, splits));
    }
  }
  if (!(count <= LargestPatchCount))
  {
    std::ostringstream message;
    message << "MaximumEdgeLength of " << maximumEdgeLength << " would give about " << count
            << " patches; choose a larger one";
    throw vantage::InputError(message.str());
  }
}

void SplitLongPatches(vantage::ElementTree& tree, double maximumEdgeLength)
{
  // Children are appended, so the loop comes to them as well.
  for (vantage::NodeId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster() && vantage::LongestEdge(tree[id]) > maximumEdgeLength)
    {
      tree.Split(id);
    }
  }
}

vtkSmartPointer<vtkPolyData> PatchesToPolyData(const vantage::ElementSurface& surface,
  const vantage::ElementTree& tree, const vantage::FacetSet& facets, vtkPolyData* input)
{
  auto patches = vtkSmartPointer<vtkPolyData>::New();
  patches->SetPoints(vantage::VerticesToPoints(surface.points));
  patches->SetPolys(vantage::PolygonsToCells(surface.indices, surface.offsets));

  const std::size_t count = surface.PolygonCount();
  const auto patchOf = [&](std::size_t p) { return tree[surface.elements[p]].patch; };
  const std::size_t firstCell = vantage::FirstPolygonCell(input);
  vtkCellData* cellData = patches->GetCellData();
  cellData->CopyAllOn(); // identifiers and normals of a polygon hold for its pieces as well
  cellData->CopyAllocate(input->GetCellData(), static_cast<vtkIdType>(count));
  for (std::size_t p = 0; p < count; ++p)
  {
    const vantage::Patch& patch = tree.Patches()[patchOf(p)];
    const std::size_t source = firstCell + facets.facets[patch.facet].ScenePolygonOf(patch.side);
    cellData->CopyData(
      input->GetCellData(), static_cast<vtkIdType>(source), static_cast<vtkIdType>(p));
  }
  cellData->AddArray(vantage::MakeArray<vtkIdTypeArray>("PatchId", count, patchOf));
  patches->GetFieldData()->PassData(input->GetFieldData());
  return patches;
}

} // namespace

int vtkPatchSubdivision::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  try
  {
    if (!(this->MaximumEdgeLength > 0.0))
    {
      throw vantage::InputError("MaximumEdgeLength is " + std::to_string(this->MaximumEdgeLength) +
                                "; give a length above zero");
    }
    const vantage::Scene scene = vantage::PolyDataToScene(input);
    scene.Validate();
    const vantage::FacetSet facets = vantage::BuildFacets(scene);
    this->WarnOfDroppedPolygons(static_cast<vtkIdType>(facets.report.degeneratePolygons),
      static_cast<vtkIdType>(facets.report.duplicateFacets));
    vantage::ElementTree tree(facets, scene.materials, vantage::Sides::FrontOnly);
    CheckPatchCount(tree, this->MaximumEdgeLength);
    SplitLongPatches(tree, this->MaximumEdgeLength);
    const vantage::ElementSurface surface = vantage::PatchMesh(tree, facets).Surface();
    vtkPolyData::GetData(outputVector)
      ->ShallowCopy(PatchesToPolyData(surface, tree, facets, input));
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkPatchSubdivision::WarnOfDroppedPolygons(vtkIdType degenerate, vtkIdType repeated)
{
  if (degenerate > 0 || repeated > 0)
  {
    vtkWarningMacro(<< "dropped " << degenerate << " polygons without area and " << repeated
                    << " that repeat an earlier one");
  }
}

void vtkPatchSubdivision::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "MaximumEdgeLength: " << this->MaximumEdgeLength << "\n";
}
