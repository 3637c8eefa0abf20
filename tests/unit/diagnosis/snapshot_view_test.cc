#include "agent/diagnosis/snapshot_view.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "agent/diagnosis/src/frame_view.h"

namespace trailcast::agent {
namespace {

using replay::FeatureVerdict;
using testing::HasSubstr;
using testing::Not;

SnapshotFrame Frame(int width, int height) {
  SnapshotFrame frame;
  frame.picture = {width, height,
                   std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height, 128)};
  return frame;
}

image::Color ShadeAt(const image::RgbImage& picture, int x, int y) {
  const std::size_t i = 3 * image::PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

TEST(DrawSnapshot, IsSmallHoweverLargeTheCamerasPictureIs) {
  EXPECT_EQ(DrawSnapshot(Frame(1280, 720)).width, 320);
  EXPECT_EQ(DrawSnapshot(Frame(1280, 720)).height, 180);
  EXPECT_EQ(DrawSnapshot(Frame(160, 120)).width, 160);
  EXPECT_GT(DrawSnapshot(Frame(4000, 1)).height, 0);
  EXPECT_TRUE(DrawSnapshot({}).empty());
}

TEST(DrawSnapshot, PutsEachFeatureWhereItIsInTheSmallPicture) {
  for (const FeatureVerdict verdict : {FeatureVerdict::kInside, FeatureVerdict::kAsksRight,
                                       FeatureVerdict::kAsksLeft, FeatureVerdict::kRejected}) {
    SnapshotFrame frame = Frame(640, 480);
    frame.features = {{{0, 80.0, -40.0}, {0, 80.0, -40.0}, {0, 80.0, -40.0}, verdict}};
    const image::RgbImage picture = DrawSnapshot(frame);
    EXPECT_EQ(ShadeAt(picture, 160 + 40, 120 - 20), VerdictColor(verdict));
    EXPECT_EQ(ShadeAt(picture, 160 - 40, 120 + 20), (image::Color{128, 128, 128}));
  }
}

TEST(DrawSnapshot, TheTurnPointsToTheSideThatIsAskedFor) {
  SnapshotFrame frame = Frame(320, 240);
  EXPECT_EQ(DrawSnapshot(frame).height, 240) << "it does not follow";
  frame.turn_rad = 0.15;
  const image::Color ground = ShadeAt(DrawSnapshot(frame), 100, 248);
  EXPECT_NE(ShadeAt(DrawSnapshot(frame), 200, 248), ground);
  frame.turn_rad = -9.0;
  EXPECT_NE(ShadeAt(DrawSnapshot(frame), 100, 248), ground);
  EXPECT_EQ(ShadeAt(DrawSnapshot(frame), 200, 248), ground);
  frame.turn_rad = 0.0;
  EXPECT_EQ(ShadeAt(DrawSnapshot(frame), 200, 248), ground);
}

TEST(SnapshotText, SaysWhatIsDrawn) {
  SnapshotFrame frame = Frame(320, 240);
  EXPECT_THAT(SnapshotText(frame), HasSubstr("no turn"));
  frame.turn_rad = -0.0524;
  EXPECT_THAT(SnapshotText(frame), HasSubstr("3.0 degrees left"));
  EXPECT_THAT(SnapshotText(frame), Not(HasSubstr("features"))) << "it goes by none";
  EXPECT_FALSE(frame.marked());
  frame.stored = 20;
  frame.features = {{{}, {}, {}, FeatureVerdict::kInside},
                    {{}, {}, {}, FeatureVerdict::kInside},
                    {{}, {}, {}, FeatureVerdict::kAsksLeft}};
  EXPECT_THAT(SnapshotText(frame), HasSubstr("3 of 20 features: 2 in their funnel lanes, 1 ask for "
                                             "left, 0 for right, 0 rejected"));
  EXPECT_TRUE(frame.marked());
}

}  // namespace
}  // namespace trailcast::agent
