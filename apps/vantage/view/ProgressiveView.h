#pragma once

#include "core/Solver.h"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

/// \file ProgressiveView.h
/// A view that gets better while nobody waits for it.

namespace vantage
{

/// A scene that is solved for a camera in a thread of its own. Pictures come one after the other,
/// each of a smaller error than the last: a coarse one of few pixels at once, the last one with all
/// pixels and the error that is asked for. Whoever looks elsewhere meanwhile gives up all but the
/// first picture, so that there is something to see however fast the camera moves; radiance and
/// interactions are kept.
class ProgressiveView
{
public:
  struct Picture
  {
    Image radiance;
    double errorEstimate; ///< relative L1
    std::size_t interactions;
    bool isLast; ///< of this camera
  };

  /// \param error of the last picture of a camera, in (0, 1]
  /// The solver is built in the thread as well: Take() throws what is wrong with the scene.
  ProgressiveView(Scene scene, const SolverSettings& settings, double error);
  /// Gives up what is under way.
  ~ProgressiveView();
  ProgressiveView(const ProgressiveView&) = delete;
  ProgressiveView& operator=(const ProgressiveView&) = delete;

  /// Asks for pictures from there, of that size. Returns at once.
  void LookFrom(const Camera& camera, int width, int height);

  /// The newest picture, if there is one that has not been taken. Returns at once. \throw what the
  /// thread has ended with
  std::optional<Picture> Take();

private:
  struct Request
  {
    Camera camera;
    int width, height;
  };

  /// On the way to the last picture of a camera.
  struct Step
  {
    double error;
    int pixelsInOne; ///< in a row
    bool isFirst, isLast;
  };

  void Work(Scene scene, const SolverSettings& settings);
  std::optional<Request> NextRequest();
  void Show(Solver& solver, const Request& request);
  /// False when it was given up.
  bool ShowAt(Solver& solver, const Request& request, const Step& step);
  bool IsGivenUp(bool isFirst);

  const double Error;
  std::mutex Guard; ///< of all that follows
  std::condition_variable Change;
  std::optional<Request> Wanted; ///< that the thread has not seen yet
  std::optional<Picture> Newest;
  std::exception_ptr Failure;
  bool IsOver = false;
  std::thread Worker; ///< last, as it uses the others
};

} // namespace vantage
