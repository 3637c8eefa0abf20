#pragma once

#include <algorithm>
#include <cmath>

#include "services/image/image.h"
#include "services/vision/picture_intake.h"
#include "tests/support/walk_frames.h"

namespace trailcast::test {

inline constexpr int kTurningWidth_px = 160;
inline constexpr int kTurningHeight_px = 120;
inline constexpr double kTurningFocal_px = 0.87 * kTurningWidth_px;  // a usual webcam's

// Returns the heading, counter-clockwise, of a robot that turns to the left, to the right, and so
// on.
inline double HeadingAt(int frame) { return 0.5 * std::sin(0.12 * frame); }

// Returns the walk's picture `frame` by an upright camera on a robot with the heading `turning`.
// The picture moves to the right as the robot turns to the left.
inline image::GrayImage TurningWalkFrame(int frame, int turning) {
  constexpr int kMost_px = 90;
  const int right_px = static_cast<int>(std::lround(kTurningFocal_px * HeadingAt(turning)));
  const image::GrayImage wall =
      WalkFrame(frame, kTurningWidth_px + 2 * kMost_px, kTurningHeight_px);
  image::GrayImage picture{kTurningWidth_px, kTurningHeight_px, {}};
  for (int y = 0; y < kTurningHeight_px; ++y) {
    const auto row = wall.pixels.begin() + std::ptrdiff_t{y} * wall.width + kMost_px - right_px;
    picture.pixels.insert(picture.pixels.end(), row, row + kTurningWidth_px);
  }
  return picture;
}

// Returns the picture of a camera that is rolled clockwise by so many quarter turns.
inline image::GrayImage Rolled(const image::GrayImage& picture, double roll_deg) {
  vision::PictureIntake intake({.roll_deg = -roll_deg});
  return intake.Take(picture);
}

}  // namespace trailcast::test
