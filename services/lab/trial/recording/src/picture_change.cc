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
