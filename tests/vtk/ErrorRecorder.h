#pragma once

#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkObject.h>

#include <string>
#include <utility>

namespace vantage
{

/// Collects the errors and warnings an object reports, instead of printing them.
class ErrorRecorder
{
public:
  explicit ErrorRecorder(vtkObject* object)
  {
    object->AddObserver(vtkCommand::ErrorEvent, this->Observer);
    object->AddObserver(vtkCommand::WarningEvent, this->Observer);
  }

  /// All messages since the last call, one after the other.
  std::string Take() { return std::exchange(this->Observer->Messages, {}); }

private:
  class Command : public vtkCommand
  {
  public:
    static Command* New() { return new Command; }
    void Execute(vtkObject*, unsigned long, void* text) override
    {
      this->Messages += static_cast<const char*>(text);
    }

    std::string Messages;
  };

  vtkNew<Command> Observer; // shared with the object, which may live longer
};

} // namespace vantage
