#include "services/lab/sim/core/image_formation.h"

#include <algorithm>
#include <cmath>

namespace trailcast::sim {
namespace {

constexpr std::size_t kQuantiles = 4096;
// Shorter paths in the picture (half of one, pixels) are drawn as if nothing moved.
constexpr float kShortestHalfPath_px = 0.2F;
constexpr float kLongestHalfPath_px = 20.0F;

// Returns the normal distribution's quantiles by integrating its density. This needs no inverse of
// erf, and gives the same table with every mathematics library, to well within what matters.
std::vector<float> NormalQuantiles() {
  std::vector<float> quantiles(kQuantiles);
  double x = -6.0;
  double cumulated = 0.0;
  constexpr double kStep = 1e-4;
  for (std::size_t i = 0; i < kQuantiles; ++i) {
    const double wanted = (static_cast<double>(i) + 0.5) / kQuantiles;
    while (cumulated < wanted && x < 6.0) {
      x += kStep;
      cumulated += kStep * 0.3989422804014327 * std::exp(-0.5 * (x - kStep / 2) * (x - kStep / 2));
    }
    quantiles[i] = static_cast<float>(x);
  }
  return quantiles;
}

// Change of pixel for a small change of direction, by central differences.
Eigen::Matrix<float, 2, 3> Sensitivity(const Lens& lens, const Eigen::Vector3d& direction) {
  constexpr double kStep = 1e-4;
  Eigen::Matrix<float, 2, 3> change = Eigen::Matrix<float, 2, 3>::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    const auto after = lens.Project(direction + step);
    const auto before = lens.Project(direction - step);
    if (!after || !before) continue;
    change.col(axis) = ((*after - *before) / (2.0 * kStep)).cast<float>();
  }
  return change;
}

}  // namespace

ImageFormation::ImageFormation(const CameraModel& camera, const SensorOptions& options)
    : width_(camera.width), height_(camera.height), options_(options), normal_(NormalQuantiles()) {
  const Lens lens(camera);
  const Eigen::Vector2d middle((camera.width - 1) / 2.0, (camera.height - 1) / 2.0);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      PixelOptics& pixel = optics_.emplace_back();
      const auto direction = lens.Direction({x, y});
      if (!direction) continue;
      const double radius = (Eigen::Vector2d(x, y) - middle).norm() / middle.norm();
      pixel.direction = direction->cast<float>();
      pixel.pixels_per_step = Sensitivity(lens, *direction);
      pixel.brightness =
          static_cast<float>(options.gain * (1.0 - options.vignetting * radius * radius));
    }
  }
  for (int level = 0; level < 256; ++level) {
    sigma_.push_back(static_cast<float>(
        std::sqrt(options.read_noise * options.read_noise + options.shot_noise * level)));
  }
}

float ImageFormation::Smeared(const PerfectView& view, int x, int y,
                              const Eigen::Vector2f& half_path) const {
  const float length = half_path.norm();
  const int half_count = std::clamp(static_cast<int>(1.5F * length) + 1, 1, 12);
  const Eigen::Vector2f step = half_path * (1.0F / static_cast<float>(half_count));
  float sum = view.gray[image::PixelIndex(x, y, width_)];
  for (int i = -half_count; i <= half_count; ++i) {
    if (i == 0) continue;
    const float u = std::clamp(static_cast<float>(x) + static_cast<float>(i) * step.x(), 0.0F,
                               static_cast<float>(width_ - 1) - 1e-3F);
    const float v = std::clamp(static_cast<float>(y) + static_cast<float>(i) * step.y(), 0.0F,
                               static_cast<float>(height_ - 1) - 1e-3F);
    const int column = static_cast<int>(u);
    const int row = static_cast<int>(v);
    const float right = u - static_cast<float>(column);
    const float lower = v - static_cast<float>(row);
    const float* p = &view.gray[image::PixelIndex(column, row, width_)];
    const float upper_row = p[0] + right * (p[1] - p[0]);
    const float lower_row = p[width_] + right * (p[width_ + 1] - p[width_]);
    sum += upper_row + lower * (lower_row - upper_row);
  }
  return sum / static_cast<float>(2 * half_count + 1);
}

image::GrayImage ImageFormation::Form(const PerfectView& view, const CameraMotion& motion,
                                      Random& random, double exposure) const {
  const auto brighter = static_cast<float>(exposure);
  image::GrayImage picture{width_, height_, std::vector<std::uint8_t>(optics_.size())};
  const auto half_s = static_cast<float>(options_.exposure_s / 2.0);
  const Eigen::Vector3f shift = half_s * motion.linear_mps.cast<float>();
  const Eigen::Vector3f turn = half_s * motion.angular_radps.cast<float>();
  const bool moves = shift.squaredNorm() + turn.squaredNorm() > 1e-12F;
  const bool anything_moves = moves || !view.movers.empty();
  auto mover = view.movers.begin();
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < optics_.size(); ++i) {
    const PixelOptics& pixel = optics_[i];
    float level = view.gray[i];
    Eigen::Vector3f seen_shift = shift;
    if (mover != view.movers.end() && mover->pixel == i) {
      seen_shift -= half_s * mover->velocity_mps;
      ++mover;
    }
    if (anything_moves && pixel.brightness > 0.0F) {
      // A point seen along d at depth z moves by -(turn x d + shift / z) against the camera.
      const Eigen::Vector3f change =
          pixel.direction.cross(turn) - (1.0F / view.depth_m[i]) * seen_shift;
      Eigen::Vector2f half_path = pixel.pixels_per_step * change;
      const float square = half_path.squaredNorm();
      if (square > kLongestHalfPath_px * kLongestHalfPath_px) {
        half_path *= kLongestHalfPath_px / std::sqrt(square);
      }
      if (square > kShortestHalfPath_px * kShortestHalfPath_px) {
        const int x = static_cast<int>(i) % width_;
        level = Smeared(view, x, static_cast<int>(i) / width_, half_path);
      }
    }
    level = std::min(brighter * level * pixel.brightness, 255.0F);
    if (i % 4 == 0) bits = random.Bits();  // 12 bits a pixel
    const float noise = normal_[bits & (kQuantiles - 1)] * sigma_[static_cast<std::size_t>(level)];
    bits >>= 16U;
    picture.pixels[i] = static_cast<std::uint8_t>(std::clamp(level + noise + 0.5F, 0.0F, 255.0F));
  }
  return picture;
}

}  // namespace trailcast::sim
