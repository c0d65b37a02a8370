"""The filters from Python: a box with a lamp, subdivided, solved and tone-mapped."""

from vtkmodules.vtkCommonCore import vtkPoints, vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkCamera

import vantage


def lit_box():
    """A unit box seen from inside, with a lamp under its ceiling."""
    faces = [
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
        [(0, 0, 1), (0, 1, 1), (1, 1, 1), (1, 0, 1)],
        [(0, 0, 0), (0, 1, 0), (0, 1, 1), (0, 0, 1)],
        [(1, 0, 0), (1, 0, 1), (1, 1, 1), (1, 1, 0)],
        [(0, 0, 0), (0, 0, 1), (1, 0, 1), (1, 0, 0)],
        [(0, 1, 0), (1, 1, 0), (1, 1, 1), (0, 1, 1)],
        [(.3, .3, .9), (.3, .7, .9), (.7, .7, .9), (.7, .3, .9)],
    ]
    points, polygons = vtkPoints(), vtkCellArray()
    emission = vtkDoubleArray()
    emission.SetName("Emission")
    for face in faces:
        polygons.InsertNextCell(4)
        for corner in face:
            polygons.InsertCellPoint(points.InsertNextPoint(corner))
        emission.InsertNextValue(10.0 if len(faces) == polygons.GetNumberOfCells() else 0.0)
    box = vtkPolyData()
    box.SetPoints(points)
    box.SetPolys(polygons)
    box.GetCellData().AddArray(emission)
    return box


def main():
    subdivision = vantage.vtkPatchSubdivision()
    subdivision.SetInputData(lit_box())
    subdivision.SetMaximumEdgeLength(0.5)

    camera = vtkCamera()
    camera.SetPosition(0.1, 0.1, 0.5)
    camera.SetFocalPoint(0.9, 0.8, 0.1)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(60)

    shooting = vantage.vtkImportanceDrivenShooting()
    shooting.SetInputConnection(subdivision.GetOutputPort())
    shooting.SetCamera(camera)
    shooting.SetError(0.05)
    shooting.SetMaximumLevel(1)
    shooting.SetViewRays(1024)

    mapping = vantage.vtkRadianceToneMapping()
    mapping.SetInputConnection(shooting.GetOutputPort())
    mapping.Update()

    elements = mapping.GetOutput()
    assert elements.GetNumberOfCells() >= 25
    assert elements.GetCellData().GetArray("RGB").GetRange(0)[1] > 0
    history = shooting.GetOutputDataObject(2)
    last = history.GetNumberOfRows() - 1
    assert last >= 0
    assert history.GetValueByName(last, "ErrorEstimate").ToDouble() <= 0.05
    assert shooting.GetOutput(1).GetNumberOfLines() > 0


main()
