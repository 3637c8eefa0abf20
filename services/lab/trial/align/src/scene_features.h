#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "services/image/image.h"

namespace trailcast::trial {

// A place in a picture that can be found again in another picture of the same scene.
struct SceneFeature {
  float x_px = 0.0F;  // in the recording's own pixels
  float y_px = 0.0F;
  // RootSIFT (Arandjelovic and Zisserman 2012): the root of each share of the SIFT histogram, in
  // 512ths.
  std::array<std::uint8_t, 128> descriptor{};
};

// Of one picture, the strongest first.
struct SceneFeatures {
  int width_px = 0;  // of the picture
  std::vector<SceneFeature> features;
};

// Small pictures are magnified for it. `camera_mask` is 0 where the camera sees itself, of the
// picture's size; empty: nowhere. For a computer, not for a robot: a tenth of a second.
[[nodiscard]] SceneFeatures FindSceneFeatures(const image::GrayImage& picture,
                                              const image::GrayImage& camera_mask);

}  // namespace trailcast::trial
