#pragma once

#include "services/base/result.h"
#include "services/image/image.h"

namespace trailcast::trial {

// Finds what of a recording's pictures never changes: a fisheye's black surround, the robot's own
// hood. Features there would agree with every picture.
class CameraMask {
 public:
  // All frames have one size.
  void Add(const image::GrayImage& frame);
  // 255 where the scene is seen, 0 where the camera sees itself, with a margin. Nothing if
  // too few frames were added to tell, or hardly anything changes at all.
  [[nodiscard]] image::GrayImage Find() const;

 private:
  int frames_ = 0;
  image::GrayImage darkest_;
  image::GrayImage brightest_;
};

}  // namespace trailcast::trial
