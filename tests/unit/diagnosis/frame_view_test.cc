#include "agent/diagnosis/src/frame_view.h"

#include <gtest/gtest.h>

#include <array>

namespace trailcast::agent {
namespace {

using replay::FeatureVerdict;

image::GrayImage GreyFrame(int width, int height) {
  return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, 128)};
}

image::Color At(const image::RgbImage& picture, int x, int y) {
  const std::size_t i = 3 * image::PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

TEST(DrawFrameView, EnlargesSmallFramesAndLeavesLargeOnes) {
  EXPECT_EQ(DrawFrameView(GreyFrame(160, 120), {}, {}).width, 640);
  EXPECT_GT(DrawFrameView(GreyFrame(160, 120), {}, {}).height, 480) << "room for the words";
  EXPECT_EQ(DrawFrameView(GreyFrame(1280, 720), {}, {}).width, 1280);
}

TEST(DrawFrameView, PutsEachFeatureWhereItIsInItsVerdictsColour) {
  for (const FeatureVerdict verdict : {FeatureVerdict::kInside, FeatureVerdict::kAsksRight,
                                       FeatureVerdict::kAsksLeft, FeatureVerdict::kRejected}) {
    const replay::FeatureView feature{
        {0, 40.0, -20.0}, {0, 40.0, -20.0}, {0, 40.0, -20.0}, verdict};
    const image::RgbImage picture = DrawFrameView(GreyFrame(320, 240), {}, std::array{feature});
    EXPECT_EQ(At(picture, 2 * (160 + 40), 2 * (120 - 20)), VerdictColor(verdict));
    EXPECT_EQ(At(picture, 2 * (160 - 40), 2 * (120 + 20)), (image::Color{128, 128, 128}));
  }
}

TEST(DrawFrameView, LinesGoToTheMilestoneButARejectedOnesToWhereItShouldBe) {
  replay::FeatureView feature{{0, 0.0, 0.0}, {0, -60.0, 0.0}, {0, 60.0, 0.0}, {}};
  const auto grey = [&](int u_px) {
    const auto picture = DrawFrameView(GreyFrame(320, 240), {}, std::array{feature});
    return At(picture, 2 * (160 + u_px), 2 * 120) == image::Color{128, 128, 128};
  };
  feature.verdict = FeatureVerdict::kInside;
  EXPECT_FALSE(grey(40));
  EXPECT_TRUE(grey(-40));
  feature.verdict = FeatureVerdict::kRejected;
  EXPECT_TRUE(grey(40));
  EXPECT_FALSE(grey(-40));
}

TEST(DrawFrameView, AMilestoneOutsideThePictureDoesNotCrossTheWords) {
  const replay::FeatureView feature{{0, 0.0, 0.0}, {}, {0, 0.0, 400.0}, FeatureVerdict::kInside};
  const auto with = DrawFrameView(GreyFrame(320, 240), {}, std::array{feature});
  EXPECT_NE(At(with, 320, 470), (image::Color{128, 128, 128}));
  EXPECT_NE(At(with, 320, 520), VerdictColor(FeatureVerdict::kInside));
}

}  // namespace
}  // namespace trailcast::agent
