#pragma once

#include "core/math/Image.h"
#include "core/view/ToneMapping.h"

#include <string>
#include <vector>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

class vtkImageData;

/// \file VtkFile.h
/// Files that VTK reads and writes. All are written whole or not at all; every failure is an
/// InputError.

namespace vantage
{

/// .vtp, binary, compressed.
vtkSmartPointer<vtkPolyData> ReadPolyData(const std::string& path);
void WritePolyData(vtkPolyData* data, const std::string& path);

/// .vti: point array Radiance, 3 floats, W m^-2 sr^-1, row 0 at the bottom.
Image ReadVti(const std::string& path);
void WriteVti(const Image& image, const std::string& path);

/// .png, 8 bits a channel; pixels as in Image, rows from bottom to top. Reading undoes sRGB.
Image ReadPng(const std::string& path);
void WritePng(vtkImageData* image, const std::string& path);
void WritePng(
  const std::vector<ScreenColor>& pixels, int width, int height, const std::string& path);

/// The same in memory: point scalars RGB, 3 unsigned char.
vtkSmartPointer<vtkImageData> ScreenImage(
  const std::vector<ScreenColor>& pixels, int width, int height);

} // namespace vantage
