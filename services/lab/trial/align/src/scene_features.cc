#include "services/lab/trial/align/src/scene_features.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/lab/trial/recording/mat_view.h"

namespace trailcast::trial {
namespace {

constexpr double kWidth_px = 480.0;  // pictures are scaled to this
constexpr int kMostFeatures = 400;
// This is below SIFT's own 0.04, because dim halls and worn floors have little contrast.
constexpr double kContrast = 0.02;
constexpr double kEdge = 10.0;  // SIFT's own

void ToRootSift(const float* histogram, SceneFeature& feature) {
  float sum = 1e-6F;
  for (std::size_t i = 0; i < feature.descriptor.size(); ++i) sum += histogram[i];
  for (std::size_t i = 0; i < feature.descriptor.size(); ++i) {
    const float root = std::sqrt(histogram[i] / sum);
    feature.descriptor[i] = static_cast<std::uint8_t>(std::min(255.0F, 512.0F * root + 0.5F));
  }
}

}  // namespace

SceneFeatures FindSceneFeatures(const image::GrayImage& picture,
                                const image::GrayImage& camera_mask) {
  const double scale = kWidth_px / picture.width;
  cv::Mat scaled;
  cv::resize(View(picture), scaled, {}, scale, scale,
             scale > 1.0 ? cv::INTER_CUBIC : cv::INTER_AREA);
  cv::Mat mask;
  if (!camera_mask.empty()) {
    cv::resize(View(camera_mask), mask, scaled.size(), 0.0, 0.0, cv::INTER_NEAREST);
  }
  std::vector<cv::KeyPoint> points;
  cv::Mat histograms;
  cv::SIFT::create(kMostFeatures, 3, kContrast, kEdge)
      ->detectAndCompute(scaled, mask, points, histograms);
  SceneFeatures found{picture.width, std::vector<SceneFeature>(points.size())};
  for (std::size_t i = 0; i < points.size(); ++i) {
    found.features[i].x_px = static_cast<float>(points[i].pt.x / scale);
    found.features[i].y_px = static_cast<float>(points[i].pt.y / scale);
    ToRootSift(histograms.ptr<float>(static_cast<int>(i)), found.features[i]);
  }
  return found;
}

}  // namespace trailcast::trial
