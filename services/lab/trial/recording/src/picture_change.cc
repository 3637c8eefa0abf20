#include "services/lab/trial/recording/picture_change.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "services/image/files.h"
#include "services/lab/trial/recording/mat_view.h"
#include "services/lab/trial/recording/src/grey_response.h"
#include "services/lab/trial/recording/src/other_camera.h"

namespace trailcast::trial {
namespace {

using image::GrayImage;

constexpr double kMorePixels = 1.25;
constexpr double kCameraGamma = 0.7;

GrayImage OtherCameraSees(const GrayImage& frame, double magnification) {
  OtherCamera camera;
  camera.width = static_cast<int>(std::lround(kMorePixels * frame.width));
  camera.height = static_cast<int>(std::lround(kMorePixels * frame.height));
  camera.magnification = magnification;
  camera.gamma = kCameraGamma;
  return Through(camera, frame);
}

GrayImage Noisy(GrayImage frame, double sigma, std::uint64_t seed) {
  cv::Mat picture = View(frame);
  cv::Mat noise(picture.size(), CV_32F);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, sigma);
  cv::add(picture, noise, picture, cv::noArray(), CV_8U);
  return frame;
}

Result<GrayImage> ThroughJpeg(const GrayImage& frame, double quality) {
  return image::EncodeJpeg(frame, static_cast<int>(quality))
      .and_then([](const std::vector<std::uint8_t>& bytes) {
        return image::DecodeGray(bytes, "a frame made JPEG");
      });
}

// Grease blurs what is behind it, and scattered light makes that paler. Its edge is soft.
GrayImage Smeared(GrayImage frame, double radius_share, std::uint64_t seed) {
  constexpr double kStrayLight = 180.0;
  constexpr double kStrayShare = 0.25;
  cv::RNG random(seed);
  const double radius = radius_share * frame.width;
  const cv::Point center(static_cast<int>(frame.width * random.uniform(0.25, 0.75)),
                         static_cast<int>(frame.height * random.uniform(0.25, 0.75)));
  cv::Mat picture = View(frame);
  cv::Mat sharp;
  picture.convertTo(sharp, CV_32F);
  cv::Mat blurred;
  cv::GaussianBlur(sharp, blurred, {}, 0.4 * radius);
  blurred = (1.0 - kStrayShare) * blurred + kStrayShare * kStrayLight;
  cv::Mat mask = cv::Mat::zeros(picture.size(), CV_32F);
  cv::circle(mask, center, static_cast<int>(radius), 1.0, cv::FILLED);
  cv::GaussianBlur(mask, mask, {}, 0.2 * radius);
  cv::Mat smeared = sharp + mask.mul(blurred - sharp);
  smeared.convertTo(picture, CV_8U);
  return frame;
}

GrayImage Cropped(const GrayImage& frame, double share) {
  const int left = static_cast<int>(std::lround(share * frame.width));
  const int below = static_cast<int>(std::lround(share * frame.height));
  GrayImage cropped = Blank(frame.width - left, frame.height - below);
  cv::Mat target = View(cropped);
  View(frame)(cv::Rect(left, 0, cropped.width, cropped.height)).copyTo(target);
  return cropped;
}

// A robot that turns or shakes blurs mostly sideways, and in each picture otherwise.
GrayImage Blurred(GrayImage frame, double longest_share, std::uint64_t seed) {
  constexpr double kSteepest_rad = 0.5;
  cv::RNG random(seed);
  const int length = 1 + static_cast<int>(random.uniform(0.0, longest_share) * frame.width);
  if (length < 2) return frame;
  const double angle_rad = random.uniform(-kSteepest_rad, kSteepest_rad);
  cv::Mat along = cv::Mat::zeros(2 * length + 1, 2 * length + 1, CV_32F);
  const cv::Point2d half(0.5 * length * std::cos(angle_rad), 0.5 * length * std::sin(angle_rad));
  const cv::Point2d middle(length, length);
  cv::line(along, middle - half, middle + half, 1.0);
  along /= cv::sum(along)[0];
  cv::Mat picture = View(frame);
  cv::filter2D(picture, picture, -1, along, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return frame;
}

// The sun stands low before the robot, and goes from one side to the other and back as the robot
// turns. The camera exposes less, and what the lens scatters lies over the whole picture.
GrayImage Flared(GrayImage frame, double veil, std::uint64_t seed, int number) {
  constexpr double kWhite = 255.0;
  constexpr double kExposure = 0.55;
  constexpr double kFramesAcross = 60.0;
  constexpr double kDisc = 0.05;  // these are shares of the width
  constexpr double kGlare = 0.35;
  constexpr double kGhost = 0.03;
  constexpr int kStreaks = 6;
  constexpr int kGhosts = 3;
  cv::RNG random(seed);
  const double phase = random.uniform(0.0, 2.0 * CV_PI) + CV_PI * number / kFramesAcross;
  const double high = random.uniform(0.1, 0.3);
  const double width = frame.width;
  const cv::Point2d middle(0.5 * width, 0.5 * frame.height);
  const cv::Point2d sun((0.5 + 0.45 * std::sin(phase)) * width, high * frame.height);
  cv::Mat light = cv::Mat::zeros(frame.height, frame.width, CV_32F);
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const double away = std::hypot(x - sun.x, y - sun.y) / width;
      light.at<float>(y, x) = static_cast<float>(
          kWhite * veil * (0.2 + 0.8 * std::exp(-away / kGlare)) + (away < kDisc ? kWhite : 0.0));
    }
  }
  cv::Mat spots = cv::Mat::zeros(light.size(), CV_32F);
  for (int i = 0; i < kStreaks; ++i) {
    const double angle_rad = CV_PI * i / kStreaks + 0.2;
    const cv::Point2d end(0.3 * width * std::cos(angle_rad), 0.3 * width * std::sin(angle_rad));
    cv::line(spots, sun - end, sun + end, 0.4 * kWhite * veil);
  }
  for (int i = 1; i <= kGhosts; ++i) {
    const cv::Point2d at = middle + (middle - sun) * (0.5 * i);
    cv::circle(spots, at, static_cast<int>(kGhost * i * width), 0.3 * kWhite * veil, cv::FILLED);
  }
  cv::GaussianBlur(spots, spots, {}, 0.01 * width);
  cv::Mat picture = View(frame);
  cv::Mat lit;
  picture.convertTo(lit, CV_32F, kExposure);
  lit += light + spots;
  lit.convertTo(picture, CV_8U);
  return frame;
}

Result<GrayImage> Changed(GrayImage frame, const Change& change, std::uint64_t seed, int number) {
  // The number is spread over all bits, so that neither pictures nor seeds share their noise.
  const std::uint64_t own =
      ((seed << 32U) + static_cast<std::uint64_t>(number) + 1) * 0x9E3779B97F4A7C15ULL;
  switch (change.kind) {
    case ChangeKind::kCamera:
      return OtherCameraSees(frame, change.value);
    case ChangeKind::kGamma: {
      cv::Mat picture = View(frame);
      Respond(change.value, picture);
      return frame;
    }
    case ChangeKind::kNoise:
      return Noisy(std::move(frame), change.value, own);
    case ChangeKind::kJpeg:
      return ThroughJpeg(frame, change.value);
    case ChangeKind::kSmear:
      return Smeared(std::move(frame), change.value, seed + 1);
    case ChangeKind::kCrop:
      return Cropped(frame, change.value);
    case ChangeKind::kBlur:
      return Blurred(std::move(frame), change.value, own);
    case ChangeKind::kFlare:
      return Flared(std::move(frame), change.value, seed + 1, number);
    case ChangeKind::kEvery:
    case ChangeKind::kSlower:
    case ChangeKind::kReverse:
    case ChangeKind::kSkip:
    case ChangeKind::kJump:
    case ChangeKind::kFrom:
      break;  // these change only the order
  }
  return frame;
}

}  // namespace

Result<GrayImage> PictureChanger::Apply(GrayImage frame, int number) const {
  for (const Change& change : disturbance_) {
    auto changed = Changed(std::move(frame), change, seed_, number);
    if (!changed) return changed;
    frame = std::move(*changed);
  }
  return frame;
}

}  // namespace trailcast::trial
