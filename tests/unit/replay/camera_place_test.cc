#include "services/replay/camera_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "services/replay/path_estimator.h"
#include "tests/support/taught_segment.h"

namespace trailcast::replay {
namespace {

const test::LandmarkScene kScene = test::LandmarkScene::Corridor(4.0, 16.0, 90, 5);

// How far from where the scout saw its features a follower beside the path puts what it sees of
// them, in scout's pixels: the median.
double OffBy_px(const motion::Pose2& pose, double magnification, double roll_rad) {
  const auto run = test::TeachArcs(kScene, {}, {{2.0, 0.0}});
  PathEstimator estimator(320, magnification);
  estimator.Learn(run.segment);
  estimator.Begin(run.segment);
  estimator.Predict({pose.x_m, 0.0});
  const auto seen = test::Matched(kScene, run, pose, {.roll_rad = roll_rad},
                                  magnification * test::LandmarkScene::kFocal_px);
  for (int i = 0; i < 5; ++i) EXPECT_GE(estimator.Update(seen).agreeing, 10);
  const CameraPlace place = estimator.camera_place();
  const std::vector<InverseDepth> depths = estimator.Depths(run.segment);
  const auto taught = test::Matched(kScene, run, {place.along_m, 0.0, 0.0});
  std::vector<double> off_px;
  for (const route::TrackedFeature& there : taught) {
    for (const route::TrackedFeature& here : seen) {
      if (here.id != there.id) continue;
      const auto depth = depths[static_cast<std::size_t>(here.id)].At(place.along_m);
      off_px.push_back(
          (place.AsTaught({here.u_px, here.v_px}, depth) - Eigen::Vector2d(there.u_px, there.v_px))
              .norm());
    }
  }
  EXPECT_GE(off_px.size(), 10U);
  std::sort(off_px.begin(), off_px.end());
  return off_px[off_px.size() / 2];
}

TEST(CameraPlace, TellsWhatIsSeenFromThePathAsTheScoutSawIt) {
  EXPECT_LT(OffBy_px({1.0, 0.0, 0.0}, 1.0, 0.0), 0.5);
}

TEST(CameraPlace, AndFromBesideItTurnedAndTiltedByAnotherCamera) {
  EXPECT_LT(OffBy_px({1.0, 0.1, 0.0}, 1.0, 0.0), 1.0);
  EXPECT_LT(OffBy_px({1.0, 0.0, 0.08}, 1.0, 0.0), 1.0);
  EXPECT_LT(OffBy_px({1.0, 0.0, 0.0}, 1.0, 0.03), 1.0);
  EXPECT_LT(OffBy_px({1.0, -0.1, -0.05}, 1.2, 0.02), 1.5);
}

}  // namespace
}  // namespace trailcast::replay
