#include "agent/device/robot_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>

#include "agent/device/src/scan_measures.h"
#include "tests/support/walk_frames.h"

namespace trailcast::agent {
namespace {

image::GrayImage Blurred(const image::GrayImage& sharp, int reach) {
  image::GrayImage blurred = sharp;
  for (int y = 0; y < sharp.height; ++y) {
    for (int x = 0; x < sharp.width; ++x) {
      int sum = 0;
      for (int off = -reach; off <= reach; ++off) {
        sum += sharp.at(std::clamp(x + off, 0, sharp.width - 1), y);
      }
      blurred.pixels[image::PixelIndex(x, y, sharp.width)] =
          static_cast<std::uint8_t>(sum / (2 * reach + 1));
    }
  }
  return blurred;
}

TEST(MeasurePicture, TellsSharpFromBlurredWhateverTheContrast) {
  const image::GrayImage sharp = test::WalkFrame(0);
  image::GrayImage faint = sharp;
  for (std::uint8_t& pixel : faint.pixels) pixel = static_cast<std::uint8_t>(100 + pixel / 4);
  EXPECT_GT(MeasurePicture(sharp).sharpness, 0.34);
  EXPECT_GT(MeasurePicture(faint).sharpness, 0.34);
  EXPECT_LT(MeasurePicture(Blurred(sharp, 6)).sharpness, 0.34);
}

TEST(MeasurePicture, TellsBrightnessAndContrast) {
  image::GrayImage picture{4, 2, {0, 200, 0, 200, 0, 200, 0, 200}};
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).brightness, 100.0);
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).contrast, 100.0);
  std::fill(picture.pixels.begin(), picture.pixels.end(), std::uint8_t{7});
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).contrast, 0.0);
  EXPECT_DOUBLE_EQ(MeasurePicture(picture).sharpness, 0.0);
}

// A quarter of a turn a range: ahead, left, behind, right.
motion::Scan Around(float ahead_m, float left_m, float behind_m, float right_m) {
  return {0.0, std::numbers::pi / 2.0, 0.1, 8.0, {ahead_m, left_m, behind_m, right_m}};
}

TEST(MeasureScan, CountsWhatIsSeen) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  const ScanMeasures scan = MeasureScan(Around(2.0F, kNothing, 0.5F, 0.05F), {});
  EXPECT_EQ(scan.ranges, 4);
  EXPECT_EQ(scan.seen, 2);
  EXPECT_EQ(scan.within_robot, 0);
}

TEST(MeasureScan, TellsARobotThatSeesItself) {
  ObstacleOptions robot;
  robot.robot_width_m = 0.6;
  robot.scan_ahead_m = 0.4;
  // From a scanner at the front: the first is ahead of the robot, the last beside it.
  const ScanMeasures scan = MeasureScan(Around(0.2F, 0.25F, 0.3F, 0.35F), robot);
  EXPECT_EQ(scan.within_robot, 1) << "the front's edge is none of its own";
  EXPECT_NEAR((scan.first_within - Eigen::Vector2d(0.1, 0.0)).norm(), 0.0, 1e-6);
}

TEST(Coming, IsCountedByWhenItComes) {
  Coming coming;
  EXPECT_EQ(coming.rate_hz(), 0.0);
  for (int i = 0; i < 11; ++i) coming.Note(Coming::Time(std::chrono::milliseconds(100 * i)));
  EXPECT_EQ(coming.count(), 11);
  EXPECT_NEAR(coming.rate_hz(), 10.0, 1e-9);
}

}  // namespace
}  // namespace trailcast::agent
