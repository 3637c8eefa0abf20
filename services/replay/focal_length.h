#pragma once

namespace trailcast::replay {

// This is the focal length of a camera, in its own pixels.
struct FocalLength {
  double px = 0.0;
  double sigma = 0.0;  // relative
};

}  // namespace trailcast::replay
