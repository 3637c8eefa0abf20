#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/lab/trial/recording/disturbance.h"

namespace trailcast::trial {

// What a disturbance does to pictures.
class PictureChanger {
 public:
  // What is drawn (a smear's place, noise) is drawn from `seed`.
  PictureChanger(Disturbance disturbance, std::uint64_t seed)
      : disturbance_(std::move(disturbance)), seed_(seed) {}

  // `number` is the picture's place in the order shown: its noise is its own. All pictures of one
  // size come out in one size. An error is one of the JPEG library.
  [[nodiscard]] Result<image::GrayImage> Apply(image::GrayImage frame, int number) const;

 private:
  Disturbance disturbance_;
  std::uint64_t seed_;
};

}  // namespace trailcast::trial
