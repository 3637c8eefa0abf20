#include "services/teach/picture_shake.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace trailcast::teach {
namespace {

constexpr double kFocal_px = 300.0;
constexpr int kHeight_px = 240;

// A camera half a metre above the ground drives past what stands at different heights, nodding.
class Camera {
 public:
  double rate_hz = 30.0;
  double speed_mps = 0.5;
  double nod_rad = 0.0;  // the most
  double nod_hz = 2.0;
  double noise_px = 0.05;  // of each feature
  int leapers = 0;         // of its features, which jump up and down by themselves
  int features = 40;
  bool drives = true;

  void Drive(PictureShake& shake, double seconds) {
    for (int i = 0; i < std::lround(seconds * rate_hz); ++i) {
      t_s_ += 1.0 / rate_hz;
      if (drives) driven_m_ += speed_mps / rate_hz;
      shake.Add(FromSeconds(t_s_), Look(), drives);
    }
  }
  void Begin(PictureShake& shake) { shake.Begin(Look()); }

 private:
  std::vector<route::TrackedFeature> Look() {
    std::vector<route::TrackedFeature> seen;
    const double nod_px = kFocal_px * nod_rad * std::sin(2.0 * std::numbers::pi * nod_hz * t_s_);
    for (int id = 0; id < features; ++id) {
      const double ahead_m = 8.0 + 0.3 * id - driven_m_;
      const double below_m = 0.5 - 0.05 * id;
      double v_px = kFocal_px * below_m / ahead_m + nod_px + noise_px * normal_(random_);
      if (id < leapers) v_px += 5.0 * std::sin(12.0 * t_s_);
      seen.push_back({id, 0.0, v_px});
    }
    return seen;
  }

  double t_s_ = 0.0;
  double driven_m_ = 0.0;
  std::mt19937 random_{7};
  std::normal_distribution<double> normal_;
};

double ShakeOf(Camera& camera) {
  PictureShake shake(kHeight_px);
  camera.Begin(shake);
  camera.Drive(shake, 6.0);
  return shake.Measure().value();
}

TEST(PictureShake, OfACameraThatGoesSmoothlyIsNextToNothing) {
  Camera camera;
  EXPECT_LT(ShakeOf(camera), 0.001);
}

TEST(PictureShake, IsHowFarACameraNodsAtAnyFrameRate) {
  for (const double rate_hz : {15.0, 30.0, 60.0}) {
    Camera camera;
    camera.rate_hz = rate_hz;
    camera.nod_rad = 0.02;
    const double rms = 0.02 * kFocal_px / std::numbers::sqrt2 / kHeight_px;
    EXPECT_NEAR(ShakeOf(camera), rms, 0.2 * rms) << rate_hz;
  }
}

TEST(PictureShake, LeavesSlowHillsOut) {
  Camera camera;
  camera.nod_rad = 0.02;
  camera.nod_hz = 0.1;
  EXPECT_LT(ShakeOf(camera), 0.003);
}

TEST(PictureShake, IsNotThatOfAThirdOfTheFeaturesWhichMoveByThemselves) {
  Camera camera;
  camera.leapers = 13;
  EXPECT_LT(ShakeOf(camera), 0.003);
}

TEST(PictureShake, IsNotThatOfARobotThatBrakes) {
  Camera camera;
  PictureShake shake(kHeight_px);
  camera.Begin(shake);
  camera.Drive(shake, 3.0);
  camera.speed_mps = 0.1;
  camera.Drive(shake, 3.0);
  EXPECT_LT(shake.Measure().value(), 0.003);
}

TEST(PictureShake, IsNotKnownWithFewFeaturesNorOfARobotThatStands) {
  Camera few;
  few.features = 7;
  PictureShake shake(kHeight_px);
  few.Begin(shake);
  few.Drive(shake, 6.0);
  EXPECT_FALSE(shake.Measure());
  Camera stands;
  stands.drives = false;
  stands.Drive(shake, 6.0);
  EXPECT_FALSE(shake.Measure());
}

TEST(PictureShake, GoesOnOverSegmentsAndTellsEachOfItsOwn) {
  Camera camera;
  PictureShake shake(kHeight_px);
  camera.Begin(shake);
  camera.Drive(shake, 3.0);
  EXPECT_LT(shake.Measure().value(), 0.001);
  shake.EndSegment();
  camera.Begin(shake);
  camera.nod_rad = 0.02;
  camera.Drive(shake, 4.0);
  EXPECT_GT(shake.Measure().value(), 0.01);
}

}  // namespace
}  // namespace trailcast::teach
