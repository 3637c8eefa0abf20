#include "services/lab/sim/core/image_formation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trailcast::sim {
namespace {

// A camera and views made by hand: grey levels and depths without a world.
class ImageFormationTest : public ::testing::Test {
 protected:
  PerfectView Even(float gray) const {
    const auto pixels = image::PixelIndex(0, camera_.height, camera_.width);
    return {camera_.width, camera_.height, std::vector<float>(pixels, gray),
            std::vector<float>(pixels, 2.0F)};
  }
  // Left half black, right half white.
  PerfectView Halves() const {
    PerfectView view = Even(0.0F);
    for (std::size_t i = 0; i < view.gray.size(); ++i)
      view.gray[i] = i % 320 < 160 ? 20.0F : 200.0F;
    return view;
  }
  image::GrayImage Form(const PerfectView& view, const SensorOptions& options,
                        const CameraMotion& motion = {}) const {
    Random random(5, "test");
    return ImageFormation(camera_, options).Form(view, motion, random);
  }
  // Pixels of the middle row between dark and bright.
  static int WidthOfEdge(const image::GrayImage& picture) {
    int width = 0;
    for (int x = 0; x < picture.width; ++x) {
      width += picture.at(x, 120) > 35 && picture.at(x, 120) < 170 ? 1 : 0;
    }
    return width;
  }
  CameraModel camera_ = *FindCamera("webcam");
  SensorOptions clean_{0.010, 1.0, 0.0, 0.0, 0.0};
};

TEST_F(ImageFormationTest, WithoutFlawsThePictureIsTheView) {
  const auto picture = Form(Even(120.0F), clean_);
  EXPECT_EQ(picture.width, 320);
  for (const auto pixel : picture.pixels) ASSERT_EQ(pixel, 120);
}

TEST_F(ImageFormationTest, NoiseHasItsSigmaAndNoBias) {
  SensorOptions noisy;
  noisy.vignetting = 0.0;
  const auto picture = Form(Even(128.0F), noisy);
  double sum = 0.0;
  double squares = 0.0;
  for (const auto pixel : picture.pixels) {
    sum += pixel - 128.0;
    squares += (pixel - 128.0) * (pixel - 128.0);
  }
  const auto count = static_cast<double>(picture.pixels.size());
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_GT(std::sqrt(squares / count), 2.0);
  EXPECT_LT(std::sqrt(squares / count), 3.0);
}

TEST_F(ImageFormationTest, GainScalesAndClips) {
  SensorOptions bright = clean_;
  bright.gain = 1.4;
  EXPECT_EQ(Form(Even(100.0F), bright).at(160, 120), 140);
  EXPECT_EQ(Form(Even(220.0F), bright).at(160, 120), 255);
}

TEST_F(ImageFormationTest, CornersAreDarkerByTheVignette) {
  SensorOptions options = clean_;
  options.vignetting = 0.25;
  const auto picture = Form(Even(200.0F), options);
  EXPECT_EQ(picture.at(160, 120), 200);
  EXPECT_NEAR(picture.at(0, 0), 150, 1);
}

TEST_F(ImageFormationTest, TurningSmearsByTheAngleTurnedDuringTheExposure) {
  const int still = WidthOfEdge(Form(Halves(), clean_));
  EXPECT_LE(still, 1);
  CameraMotion turning;
  turning.angular_radps.y() = 2.0;  // 0.02 rad in 10 ms: about 5.5 pixels at this focal length
  EXPECT_NEAR(WidthOfEdge(Form(Halves(), clean_, turning)), 4, 1.5);
}

TEST_F(ImageFormationTest, DrivingSidewaysSmearsNearThingsOnly) {
  CameraMotion sideways;
  sideways.linear_mps.x() = 2.0;
  PerfectView near_view = Halves();
  for (float& depth : near_view.depth_m) depth = 0.8F;
  PerfectView far_view = Halves();
  for (float& depth : far_view.depth_m) depth = 50.0F;
  EXPECT_GE(WidthOfEdge(Form(near_view, clean_, sideways)), 3);
  EXPECT_LE(WidthOfEdge(Form(far_view, clean_, sideways)), 1);
}

}  // namespace
}  // namespace trailcast::sim
