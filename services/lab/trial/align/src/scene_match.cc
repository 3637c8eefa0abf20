#include "services/lab/trial/align/src/scene_match.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <opencv2/calib3d.hpp>
#include <utility>
#include <vector>

#include "services/base/median.h"

namespace trailcast::trial {
namespace {

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  // in teach, in replay

constexpr float kRatio = 0.85F;  // of the best to the second-best distance
constexpr std::size_t kFewestPairs = 8;
constexpr std::size_t kManyPairs = 30;  // more than pictures of different places share by chance
// The tolerance, as a share of the picture's width, between a feature and its place by the camera's
// motion.
constexpr double kOff = 0.004;
constexpr double kSure = 0.999;
constexpr int kTrials = 1000;

Matrix Descriptors(const SceneFeatures& scene) {
  constexpr Eigen::Index kSize = 128;
  Matrix rows(static_cast<Eigen::Index>(scene.features.size()), kSize);
  for (std::size_t i = 0; i < scene.features.size(); ++i) {
    const auto& descriptor = scene.features[i].descriptor;
    rows.row(static_cast<Eigen::Index>(i)) =
        Eigen::Map<const Eigen::Matrix<std::uint8_t, 1, kSize>>(descriptor.data()).cast<float>();
  }
  rows.rowwise().normalize();
  return rows;
}

// Returns for each row the most similar column, or -1 if the second one is almost as similar.
std::vector<Eigen::Index> ClearBest(const Matrix& likeness) {
  std::vector<Eigen::Index> best(static_cast<std::size_t>(likeness.rows()), -1);
  for (Eigen::Index row = 0; row < likeness.rows(); ++row) {
    float first = -1.0F;
    float second = -1.0F;
    Eigen::Index at = -1;
    for (Eigen::Index column = 0; column < likeness.cols(); ++column) {
      const float value = likeness(row, column);
      if (value > first) {
        second = first;
        first = value;
        at = column;
      } else {
        second = std::max(second, value);
      }
    }
    // The squared distance of unit vectors is 2 - 2 likeness.
    if (1.0F - first <= kRatio * kRatio * (1.0F - second)) best[static_cast<std::size_t>(row)] = at;
  }
  return best;
}

Pairs PairUp(const SceneFeatures& teach, const SceneFeatures& replay) {
  const Matrix likeness = Descriptors(teach) * Descriptors(replay).transpose();
  const std::vector<Eigen::Index> forth = ClearBest(likeness);
  Pairs pairs;
  for (std::size_t i = 0; i < forth.size(); ++i) {
    if (forth[i] < 0) continue;
    Eigen::Index back = 0;
    likeness.col(forth[i]).maxCoeff(&back);
    if (back == static_cast<Eigen::Index>(i)) {
      pairs.emplace_back(i, static_cast<std::size_t>(forth[i]));
    }
  }
  return pairs;
}

std::ptrdiff_t Kept(const std::vector<std::uint8_t>& agrees) {
  return std::count_if(agrees.begin(), agrees.end(), [](std::uint8_t each) { return each != 0; });
}

// Says which pairs agree on one motion of the camera. A fundamental matrix holds for any motion,
// but pictures taken at one point (by a robot that stood, or turned on the spot) do not determine
// it; these agree on a homography.
std::vector<std::uint8_t> Agreeing(const std::vector<cv::Point2d>& from,
                                   const std::vector<cv::Point2d>& to, double off_px) {
  std::vector<std::uint8_t> moved;
  if (cv::findFundamentalMat(from, to, cv::USAC_MAGSAC, off_px, kSure, kTrials, moved).empty()) {
    moved.assign(from.size(), 0);
  }
  const auto half = static_cast<std::ptrdiff_t>(from.size() / 2);
  if (from.size() < kManyPairs || Kept(moved) > half) return moved;
  std::vector<std::uint8_t> turned;
  if (cv::findHomography(from, to, cv::USAC_MAGSAC, off_px, turned, kTrials, kSure).empty()) {
    return moved;
  }
  return Kept(moved) >= Kept(turned) ? moved : turned;
}

}  // namespace

SceneMatch MatchScenes(const SceneFeatures& teach, const SceneFeatures& replay) {
  if (teach.features.size() < kFewestPairs || replay.features.size() < kFewestPairs) return {};
  const Pairs pairs = PairUp(teach, replay);
  if (pairs.size() < kFewestPairs) return {};
  const double scale = static_cast<double>(replay.width_px) / teach.width_px;
  std::vector<cv::Point2d> from;
  std::vector<cv::Point2d> to;
  for (const auto& [t, r] : pairs) {
    from.emplace_back(scale * teach.features[t].x_px, scale * teach.features[t].y_px);
    to.emplace_back(replay.features[r].x_px, replay.features[r].y_px);
  }
  const std::vector<std::uint8_t> agrees = Agreeing(from, to, kOff * replay.width_px);
  std::vector<double> du_px;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (agrees[i] != 0) du_px.push_back(to[i].x - from[i].x);
  }
  if (du_px.empty()) return {};
  return {static_cast<int>(du_px.size()), Median(std::move(du_px))};
}

}  // namespace trailcast::trial
