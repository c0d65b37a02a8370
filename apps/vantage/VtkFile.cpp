#include "VtkFile.h"

#include "SolutionAdapter.h"
#include "core/Error.h"
#include "io/AtomicFile.h"

#include <filesystem>
#include <vtkCallbackCommand.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

namespace vantage
{

namespace
{

/// Whether a reader or writer complains: not all of them set an error code.
class ErrorWatch
{
public:
  explicit ErrorWatch(vtkObject* watched)
  {
    this->Callback->SetClientData(&this->Failed);
    this->Callback->SetCallback(
      [](vtkObject*, unsigned long, void* failed, void*) { *static_cast<bool*>(failed) = true; });
    watched->AddObserver(vtkCommand::ErrorEvent, this->Callback);
  }

  bool HasFailed() const { return this->Failed; }

private:
  bool Failed = false;
  vtkNew<vtkCallbackCommand> Callback;
};

template <typename Reader>
void UpdateReader(Reader* reader, const std::string& path, const std::string& format)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    throw InputError(path + ": there is no such file; check the name");
  }
  const ErrorWatch watch(reader);
  const bool canRead = reader->CanReadFile(path.c_str()) != 0;
  if (canRead)
  {
    reader->SetFileName(path.c_str());
    reader->Update();
  }
  if (!canRead || watch.HasFailed() || reader->GetErrorCode() != 0)
  {
    throw InputError(path + ": it cannot be read as " + format + "; write it again");
  }
}

template <typename Writer>
void RunWriter(Writer* writer, const std::string& path)
{
  const ErrorWatch watch(writer);
  WriteAtomically(path,
    [&](const std::string& temporary)
    {
      writer->SetFileName(temporary.c_str());
      writer->Write();
      if (watch.HasFailed() || writer->GetErrorCode() != 0)
      {
        throw InputError(path + ": cannot be written; check that the disk is not full");
      }
    });
}

/// Pixels of an image from an array with at least `components` values each.
template <typename Convert>
Image MakeImage(vtkImageData* data, vtkDataArray* values, const Convert& convert)
{
  int size[3];
  data->GetDimensions(size);
  Image image(size[0], size[1]);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
  {
    for (int k = 0; k < 3; ++k)
    {
      // Grey images have one or two components, the others three or four.
      const int component = values->GetNumberOfComponents() < 3 ? 0 : k;
      image.pixels[p][k] = convert(values->GetComponent(static_cast<vtkIdType>(p), component));
    }
  }
  return image;
}

} // namespace

vtkSmartPointer<vtkPolyData> ReadPolyData(const std::string& path)
{
  vtkNew<vtkXMLPolyDataReader> reader;
  UpdateReader(reader.Get(), path, "VTK polygons");
  return reader->GetOutput();
}

void WritePolyData(vtkPolyData* data, const std::string& path)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  RunWriter(writer.Get(), path);
}

Image ReadVti(const std::string& path)
{
  vtkNew<vtkXMLImageDataReader> reader;
  UpdateReader(reader.Get(), path, "a VTK image");
  vtkImageData* data = reader->GetOutput();
  vtkDataArray* radiance = data->GetPointData()->GetArray("Radiance");
  if (!radiance || radiance->GetNumberOfComponents() != 3 || data->GetDimensions()[2] != 1)
  {
    throw InputError(
      path + ": it has no point array Radiance of 3 components; give an image of vantage render");
  }
  return MakeImage(data, radiance, [](double x) { return x; });
}

void WriteVti(const Image& image, const std::string& path)
{
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(ImageToImageData(image));
  RunWriter(writer.Get(), path);
}

Image ReadPng(const std::string& path)
{
  vtkNew<vtkPNGReader> reader;
  UpdateReader(reader.Get(), path, "a PNG image");
  vtkImageData* data = reader->GetOutput();
  vtkDataArray* values = data->GetPointData()->GetScalars();
  const double most = values->GetDataTypeMax();
  return MakeImage(data, values, [&](double x) { return SrgbToLinear(x / most); });
}

void WritePng(vtkImageData* image, const std::string& path)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  RunWriter(writer.Get(), path);
}

void WritePng(
  const std::vector<ScreenColor>& pixels, int width, int height, const std::string& path)
{
  WritePng(ScreenImage(pixels, width, height), path);
}

vtkSmartPointer<vtkImageData> ScreenImage(
  const std::vector<ScreenColor>& pixels, int width, int height)
{
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName("RGB");
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(static_cast<vtkIdType>(pixels.size()));
  for (std::size_t p = 0; p < pixels.size(); ++p)
  {
    colors->SetTypedTuple(static_cast<vtkIdType>(p), pixels[p].data());
  }
  const auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->GetPointData()->SetScalars(colors);
  return image;
}

} // namespace vantage
