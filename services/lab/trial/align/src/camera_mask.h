#pragma once

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::trial {

// Finds the parts of a recording's pictures that never change: a fisheye's black surround, the
// robot's own hood. Features there would match every picture.
class CameraMask {
 public:
  // All frames have one size.
  void Add(const image::GrayImage& frame);
  // Returns 255 where the scene is visible, and 0, with a margin, where the camera sees its own
  // robot. It is empty if too few frames were added, or hardly anything changes.
  [[nodiscard]] image::GrayImage Find() const;

 private:
  int frames_ = 0;
  image::GrayImage darkest_;
  image::GrayImage brightest_;
};

}  // namespace trailcast::trial
