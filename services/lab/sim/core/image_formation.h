#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/image/image.h"
#include "services/lab/sim/core/camera_renderer.h"
#include "services/lab/sim/core/random.h"

namespace trailcast::sim {

struct SensorOptions {
  double exposure_s = 0.010;  // for a cheap camera in indoor light; motion smears
  double gain = 1.0;          // of the grey levels, from auto-exposure
  double vignetting = 0.25;   // share of light lost in the picture's corners
  // The noise in grey levels is sigma^2 = read^2 + shot * level: 2.4 at mid grey, 3.0 at white.
  double read_noise = 1.5;
  double shot_noise = 0.028;
};

// Turns a perfect view into a real camera's picture, with motion blur, vignetting, exposure, noise
// and 8 bits. Blur is a warp: each pixel averages the view along its own motion in the picture,
// which follows from its depth and the camera's motion. This costs a millisecond, where rendering
// the exposure several times would cost tens; it is only approximate at the borders of near things.
class ImageFormation {
 public:
  ImageFormation(const CameraModel& camera, const SensorOptions& options);

  // Takes its noise from `random`, so that the same state and view give the same picture.
  // `exposure` multiplies the brightness that the sensor's gain gives.
  [[nodiscard]] image::GrayImage Form(const PerfectView& view, const CameraMotion& motion,
                                      Random& random, double exposure = 1.0) const;

 private:
  struct PixelOptics {
    Eigen::Vector3f direction = Eigen::Vector3f::UnitZ();
    Eigen::Matrix<float, 2, 3> pixels_per_step = Eigen::Matrix<float, 2, 3>::Zero();
    float brightness = 0.0F;  // vignetting and gain; 0 outside the lens's picture
  };
  [[nodiscard]] float Smeared(const PerfectView& view, int x, int y,
                              const Eigen::Vector2f& half_path) const;

  int width_;
  int height_;
  SensorOptions options_;
  std::vector<PixelOptics> optics_;
  std::vector<float> normal_;  // the normal distribution's quantiles, evenly spaced
  std::vector<float> sigma_;   // of the noise, by grey level
};

}  // namespace trailcast::sim
