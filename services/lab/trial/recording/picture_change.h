#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/image/image.h"
#include "services/lab/trial/recording/disturbance.h"

namespace trailcast::trial {

// Applies a disturbance to pictures.
class PictureChanger {
 public:
  // `seed` draws what is random (a smear's place, noise).
  PictureChanger(Disturbance disturbance, std::uint64_t seed)
      : disturbance_(std::move(disturbance)), seed_(seed) {}

  // `number` is the picture's place in the order shown, on which its noise depends. Pictures of one
  // size stay of one size. An error is the JPEG library's.
  [[nodiscard]] Result<image::GrayImage> Apply(image::GrayImage frame, int number) const;

 private:
  Disturbance disturbance_;
  std::uint64_t seed_;
};

}  // namespace trailcast::trial
