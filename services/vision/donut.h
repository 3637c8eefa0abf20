#pragma once

#include <memory>

#include "services/image/image.h"

namespace trailcast::vision {

// Unrolls the donut that an omnidirectional mirror shows. In a donut a turn of the robot turns the
// picture, so u and v mean nothing there. The upper half, which looks ahead, becomes a panorama as
// wide as the picture: u is the bearing from -90 to 90 degrees, and the donut's outer rim is on
// top. The paper's section VI leaves out the lower half as well. The first frame decides whether
// there is a donut and where: it has a dark surround and a dark round hole in the middle.
class DonutUnroller {
 public:
  DonutUnroller();
  ~DonutUnroller();
  DonutUnroller(DonutUnroller&&) noexcept;
  DonutUnroller& operator=(DonutUnroller&&) noexcept;

  // Returns the panorama, valid until the next call, or `frame` itself if there is no donut. All
  // frames must have the size of the first.
  [[nodiscard]] const image::GrayImage& Unroll(const image::GrayImage& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::vision
