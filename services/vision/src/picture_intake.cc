#include "services/vision/picture_intake.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "services/base/angles.h"
#include "services/vision/donut.h"
#include "services/vision/src/frame.h"

namespace trailcast::vision {
namespace {

constexpr double kMostTilt_deg = 20.0;  // off a quarter turn
constexpr double kLeastTilt_deg = 0.05;

// A roll as quarter turns clockwise and a remainder.
struct Roll {
  int quarters = 0;  // 0 to 3
  double tilt_deg = 0.0;
};

Roll RollOf(double roll_deg) {
  const double quarters = std::round(roll_deg / 90.0);
  Roll roll{static_cast<int>(quarters) % 4, roll_deg - 90.0 * quarters};
  if (roll.quarters < 0) roll.quarters += 4;
  if (std::abs(roll.tilt_deg) < kLeastTilt_deg) roll.tilt_deg = 0.0;
  return roll;
}

cv::Size Reduced(cv::Size camera, int longest_side_px) {
  const int longest_px = std::max(camera.width, camera.height);
  if (longest_px <= longest_side_px) return camera;
  const double shrink = static_cast<double>(longest_side_px) / longest_px;
  return {std::max(1, cvRound(shrink * camera.width)),
          std::max(1, cvRound(shrink * camera.height))};
}

// Returns the largest upright rectangle of the same shape in a tilted picture.
cv::Size Upright(cv::Size picture, double tilt_deg) {
  const double tilt_rad = std::abs(Radians(tilt_deg));
  const double shape = static_cast<double>(std::max(picture.width, picture.height)) /
                       std::min(picture.width, picture.height);
  const double shrink = 1.0 / (std::cos(tilt_rad) + shape * std::sin(tilt_rad));
  return {static_cast<int>(shrink * picture.width), static_cast<int>(shrink * picture.height)};
}

void SetSize(image::GrayImage& image, cv::Size size) {
  image.width = size.width;
  image.height = size.height;
  image.pixels.resize(image::PixelIndex(0, size.height, size.width));
}

// Maps a pixel of the upright rectangle to the tilted picture from which it is taken.
cv::Matx23d ToTilted(cv::Size upright, cv::Size tilted, double tilt_deg) {
  const cv::Point2f from = Centre(upright);
  const cv::Point2f to = Centre(tilted);
  const double cosine = std::cos(Radians(tilt_deg));
  const double sine = std::sin(Radians(tilt_deg));
  return {cosine, sine,   to.x - cosine * from.x - sine * from.y,
          -sine,  cosine, to.y + sine * from.x - cosine * from.y};
}

}  // namespace

Result<void> CheckRoll(double roll_deg) {
  if (std::isfinite(roll_deg) && std::abs(roll_deg) <= 360.0 &&
      std::abs(RollOf(roll_deg).tilt_deg) <= kMostTilt_deg) {
    return {};
  }
  return Fail(ErrorCode::kInvalidArgument,
              "a camera rolled by {:g} degrees cannot be used: expected 0, 90, 180 or 270, give or "
              "take {:g}; mount it so",
              roll_deg, kMostTilt_deg);
}

PictureSize WorkingSize(const PictureSize& camera, const IntakeOptions& options) {
  const Roll roll = RollOf(options.roll_deg);
  cv::Size size = Reduced({camera.width, camera.height}, options.longest_side_px);
  if (roll.quarters % 2 == 1) std::swap(size.width, size.height);
  if (roll.tilt_deg != 0.0) size = Upright(size, roll.tilt_deg);
  return {size.width, size.height};
}

struct PictureIntake::State {
  IntakeOptions options;
  Roll roll;
  image::GrayImage reduced;
  image::GrayImage turned;
  image::GrayImage upright;
  DonutUnroller unroller;

  const image::GrayImage& Reduce(const image::GrayImage& frame);
  const image::GrayImage& Turn(const image::GrayImage& frame);
  const image::GrayImage& Untilt(const image::GrayImage& frame);
};

const image::GrayImage& PictureIntake::State::Reduce(const image::GrayImage& frame) {
  const cv::Mat from = View(frame);
  const cv::Size size = Reduced(from.size(), options.longest_side_px);
  if (size == from.size()) return frame;
  SetSize(reduced, size);
  cv::Mat to = View(reduced);
  cv::resize(from, to, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

const image::GrayImage& PictureIntake::State::Turn(const image::GrayImage& frame) {
  if (roll.quarters == 0) return frame;
  constexpr std::array kTurns = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                 cv::ROTATE_90_COUNTERCLOCKWISE};
  const bool on_its_side = roll.quarters % 2 == 1;
  SetSize(turned,
          on_its_side ? cv::Size(frame.height, frame.width) : cv::Size(frame.width, frame.height));
  cv::Mat to = View(turned);
  cv::rotate(View(frame), to, kTurns.at(static_cast<std::size_t>(roll.quarters) - 1));
  return turned;
}

const image::GrayImage& PictureIntake::State::Untilt(const image::GrayImage& frame) {
  if (roll.tilt_deg == 0.0) return frame;
  const cv::Mat from = View(frame);
  const cv::Size size = Upright(from.size(), roll.tilt_deg);
  SetSize(upright, size);
  cv::Mat to = View(upright);
  cv::warpAffine(from, to, ToTilted(size, from.size(), roll.tilt_deg), size,
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
  return upright;
}

PictureIntake::PictureIntake(const IntakeOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->roll = RollOf(options.roll_deg);
}
PictureIntake::~PictureIntake() = default;
PictureIntake::PictureIntake(PictureIntake&&) noexcept = default;
PictureIntake& PictureIntake::operator=(PictureIntake&&) noexcept = default;

const image::GrayImage& PictureIntake::Reduce(const image::GrayImage& frame) {
  return state_->Reduce(frame);
}

const image::GrayImage& PictureIntake::Take(const image::GrayImage& frame) {
  State& s = *state_;
  return s.unroller.Unroll(s.Untilt(s.Turn(s.Reduce(frame))));
}

}  // namespace trailcast::vision
