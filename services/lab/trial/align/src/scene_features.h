#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "services/image/image.h"

namespace trailcast::trial {

// A feature that can be found again in another picture of the same scene.
struct SceneFeature {
  float x_px = 0.0F;  // in the recording's own pixels
  float y_px = 0.0F;
  // The RootSIFT descriptor (Arandjelovic and Zisserman 2012): the root of each share of the SIFT
  // histogram, in 512ths.
  std::array<std::uint8_t, 128> descriptor{};
};

// The features of one picture, the strongest first.
struct SceneFeatures {
  int width_px = 0;  // of the picture
  std::vector<SceneFeature> features;
};

// Finds features; small pictures are magnified first. `camera_mask` has the picture's size and is 0
// where the camera sees its own robot; it may be empty. This takes a tenth of a second, which suits
// a computer but no robot.
[[nodiscard]] SceneFeatures FindSceneFeatures(const image::GrayImage& picture,
                                              const image::GrayImage& camera_mask);

}  // namespace trailcast::trial
