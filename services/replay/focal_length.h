#pragma once

namespace trailcast::replay {

// Of a camera, in its own pixels.
struct FocalLength {
  double px = 0.0;
  double sigma = 0.0;  // relative
};

}  // namespace trailcast::replay
