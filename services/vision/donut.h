#pragma once

#include <memory>

#include "services/image/image.h"

namespace trailcast::vision {

// An omnidirectional mirror shows a donut, in which a turn of the robot turns the picture: u and v
// mean nothing there. Its upper half, which looks ahead, is unrolled to a panorama as wide as the
// picture, the bearing along u from -90 to 90 degrees, the donut's outer rim on top (the paper,
// section VI, leaves out the lower half as well). Whether there is a donut, and where, the first
// frame shows: a dark surround and a dark round hole in the middle.
class DonutUnroller {
 public:
  DonutUnroller();
  ~DonutUnroller();
  DonutUnroller(DonutUnroller&&) noexcept;
  DonutUnroller& operator=(DonutUnroller&&) noexcept;

  // The panorama, valid until the next call, or `frame` itself where there is no donut. All frames
  // must have the size of the first.
  [[nodiscard]] const image::GrayImage& Unroll(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::vision
