#include "services/teach/ground_feel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trailcast::teach {
namespace {

constexpr double kGravity = 9.81;
constexpr double kFrame_s = 0.05;
constexpr int kPerFrame = 5;  // 100 Hz

// A base that stands at a slope, shaken up and down at 5 Hz.
class Base {
 public:
  double slope_rad = 0.0;
  double shakes_mps2 = 0.0;  // the most
  bool tells_attitude = false;

  std::vector<motion::ImuSample> Frame() {
    std::vector<motion::ImuSample> samples;
    for (int i = 0; i < kPerFrame; ++i) {
      t_s_ += kFrame_s / kPerFrame;
      const double shake = shakes_mps2 * std::sin(2.0 * std::numbers::pi * 5.0 * t_s_);
      const double felt = kGravity + shake;
      motion::ImuSample& sample = samples.emplace_back();
      sample.acceleration_mps2 = {felt * std::sin(slope_rad), 0.0, felt * std::cos(slope_rad)};
      if (tells_attitude) {
        sample.attitude = {0.0, -std::sin(slope_rad / 2.0), 0.0, std::cos(slope_rad / 2.0)};
        sample.acceleration_mps2->x() += 1.0;  // it speeds up
      }
    }
    return samples;
  }

 private:
  double t_s_ = 0.0;
};

void DriveOn(Base& base, GroundFeel& feel, double seconds) {
  for (int i = 0; i < std::lround(seconds / kFrame_s); ++i) feel.Add(base.Frame(), kFrame_s, true);
}

TEST(GroundFeel, TellsRoughnessAsTheRmsOfWhatShakesAlongGravityOnASlopeToo) {
  for (const double slope_rad : {0.0, 0.2}) {
    Base base;
    base.slope_rad = slope_rad;
    base.shakes_mps2 = 2.0;
    GroundFeel feel;
    DriveOn(base, feel, 4.0);
    EXPECT_NEAR(feel.vertical_mps2().value(), 2.0 / std::numbers::sqrt2, 0.02);
  }
}

TEST(GroundFeel, TellsTheSlopeByTheAccelerationUphillPositive) {
  for (const double slope_rad : {-0.15, 0.0, 0.1}) {
    Base base;
    base.slope_rad = slope_rad;
    base.shakes_mps2 = 1.0;
    GroundFeel feel;
    DriveOn(base, feel, 4.0);
    EXPECT_NEAR(feel.slope_rad().value(), slope_rad, 1e-3);
  }
}

TEST(GroundFeel, TellsTheSlopeByTheAttitudeWhereThereIsOneWhateverSpeedsUp) {
  Base base;
  base.slope_rad = 0.1;
  base.tells_attitude = true;
  GroundFeel feel;
  DriveOn(base, feel, 4.0);
  EXPECT_NEAR(feel.slope_rad().value(), 0.1, 1e-6);
}

TEST(GroundFeel, KnowsNothingWithoutSamplesOrOfARobotThatStands) {
  Base base;
  GroundFeel feel;
  for (int i = 0; i < 100; ++i) feel.Add({}, kFrame_s, true);
  for (int i = 0; i < 100; ++i) feel.Add(base.Frame(), kFrame_s, false);
  EXPECT_FALSE(feel.vertical_mps2());
  EXPECT_FALSE(feel.slope_rad());
}

TEST(GroundFeel, TellsEachSegmentOfItsOwnAndOfShortOnesWithASecondBefore) {
  Base base;
  GroundFeel feel;
  DriveOn(base, feel, 3.0);
  feel.EndSegment();
  EXPECT_FALSE(feel.slope_rad()) << "nothing was driven since";
  base.slope_rad = 0.1;
  DriveOn(base, feel, 0.25);
  EXPECT_NEAR(feel.slope_rad().value(), 0.2 * 0.1, 2e-3) << "a quarter second of one and a quarter";
  feel.EndSegment();
  DriveOn(base, feel, 9.0);
  EXPECT_NEAR(feel.slope_rad().value(), 0.1, 0.01);
}

}  // namespace
}  // namespace trailcast::teach
