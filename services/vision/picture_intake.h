#pragma once

#include <memory>

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::vision {

struct IntakeOptions {
  // How far the camera is rolled about its optical axis, clockwise as seen from behind it; pictures
  // are turned by as much. A camera that hangs upside down has 180. CheckRoll tells which values
  // are valid.
  double roll_deg = 0.0;
  // Larger pictures are reduced, because windows, spacings and tolerances of the tracker and the
  // finder are in pixels and fit pictures of 320 to 640 pixels.
  int longest_side_px = 640;
};
// The longer side that a default intake looks at. Readers may reduce pictures as far as that.
inline constexpr int kEnoughPx = IntakeOptions{}.longest_side_px;

// Refuses with kInvalidArgument a roll of more than 20 degrees off a quarter turn, because the
// upright rectangle in such a picture is too small.
[[nodiscard]] Result<void> CheckRoll(double roll_deg);

struct PictureSize {
  int width = 0;
  int height = 0;
};

// Prepares a camera's pictures before anything looks at them. It reduces them to a working size,
// turns them upright (a small roll leaves the largest upright rectangle of the same shape) and
// unrolls an omnidirectional mirror's donut. It is deterministic and not thread-safe.
class PictureIntake {
 public:
  explicit PictureIntake(const IntakeOptions& options = {});
  ~PictureIntake();
  PictureIntake(PictureIntake&&) noexcept;
  PictureIntake& operator=(PictureIntake&&) noexcept;

  // Does the first of these steps alone, so that a picture can be kept and taken later.
  [[nodiscard]] const image::GrayImage& Reduce(const image::GrayImage& frame);

  // Returns a picture that is valid until the next call, or `frame` itself if nothing is to be
  // done. All frames must have the size of the first.
  [[nodiscard]] const image::GrayImage& Take(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the size of a camera's frame once it is reduced and upright. A route's pixels are counted
// in it.
[[nodiscard]] PictureSize WorkingSize(const PictureSize& camera, const IntakeOptions& options = {});

}  // namespace trailcast::vision
