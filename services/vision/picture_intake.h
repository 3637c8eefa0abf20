#pragma once

#include <memory>

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::vision {

struct IntakeOptions {
  // How far the camera is rolled about where it looks, clockwise as seen from behind it: pictures
  // are turned by as much. 180: it hangs upside down. Valid as CheckRoll has it.
  double roll_deg = 0.0;
  // Larger pictures are reduced: windows, spacings and tolerances of tracker and finder are in
  // pixels, and fit pictures of 320 to 640 pixels.
  int longest_side_px = 640;
};

// kInvalidArgument for a roll of more than 20 degrees off a quarter turn: there is no upright
// rectangle worth looking at in such a picture.
[[nodiscard]] Result<void> CheckRoll(double roll_deg);

struct PictureSize {
  int width = 0;
  int height = 0;
};

// What a camera's pictures are made into before anything looks at them: reduced to a working size,
// turned upright (of a small roll the largest upright rectangle of the same shape is left), and
// unrolled where they show an omnidirectional mirror's donut. Deterministic; not thread-safe.
class PictureIntake {
 public:
  explicit PictureIntake(const IntakeOptions& options = {});
  ~PictureIntake();
  PictureIntake(PictureIntake&&) noexcept;
  PictureIntake& operator=(PictureIntake&&) noexcept;

  // The first of these alone, so that a picture can be kept that is taken later.
  [[nodiscard]] const image::GrayImage& Reduce(const image::GrayImage& frame);

  // Valid until the next call; `frame` itself where nothing is to be done. All frames must have the
  // size of the first.
  [[nodiscard]] const image::GrayImage& Take(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Of a frame of that size, reduced and upright: what a route's pixels are counted in.
[[nodiscard]] PictureSize WorkingSize(const PictureSize& camera, const IntakeOptions& options = {});

}  // namespace trailcast::vision
