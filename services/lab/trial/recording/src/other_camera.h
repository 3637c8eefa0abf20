#pragma once

#include "services/image/image.h"

namespace trailcast::trial {

// Another camera than the one that recorded a run, as far as its pictures allow: it magnifies more,
// distorts towards the edge, responds to light differently, and has another resolution.
struct OtherCamera {
  int width = 320;
  int height = 240;
  double magnification = 1.3;  // of the picture's content, in addition to the change of resolution
  // Barrel distortion: a point at radius r (in halves of the picture's width) moves to r (1 -
  // barrel r^2).
  double barrel = 0.1;
  double gamma = 0.6;  // brightens: 255 (grey / 255)^gamma
};

// Returns what that camera would have recorded in place of `frame`.
[[nodiscard]] image::GrayImage Through(const OtherCamera& camera, const image::GrayImage& frame);

}  // namespace trailcast::trial
