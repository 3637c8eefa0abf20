#include "services/photos/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/painted_wall.h"

namespace trailcast::photos {
namespace {

using image::GrayImage;
using test::PaintedWall;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

struct Box {
  int x, y, width, height;
};

void Fill(GrayImage& picture, const Box& box, std::uint8_t grey) {
  for (int y = box.y; y < box.y + box.height; ++y) {
    for (int x = box.x; x < box.x + box.width; ++x) {
      picture.pixels[image::PixelIndex(x, y, picture.width)] = grey;
    }
  }
}

constexpr double kScale = 1.4;
PaintedWall::View Before() {
  return {.scale = kScale, .noise_grey = 2.0, .width = kWidth, .height = kHeight};
}
// It stands elsewhere, has turned, and there is less light.
PaintedWall::View Now() {
  PaintedWall::View view = Before();
  view.scale = 1.05 * kScale;
  view.du_px = 14.0;
  view.dv_px = -6.0;
  view.gain = 0.75;
  view.roll_rad = 0.03;
  view.noise_seed = 2;
  return view;
}

TEST(Compare, MarksNothingWhereNothingHasChanged) {
  const PaintedWall wall(1);
  const auto compared = Compare(wall.Photograph(Before()), wall.Photograph(Now()));
  ASSERT_TRUE(compared) << compared.error().message;
  EXPECT_THAT(compared->changes, IsEmpty());
  EXPECT_GT(compared->overlap, 0.9);
  EXPECT_GT(compared->agreeing, 100);
}

// The first box was there at the earlier visit alone, and the second one is there at the later.
TEST(Compare, MarksWhatHasGoneAndWhatHasCome) {
  const PaintedWall wall(1);
  GrayImage before = wall.Photograph(Before());
  GrayImage now = wall.Photograph(Now());
  Fill(before, {290, 220, 60, 40}, 250);
  Fill(now, {480, 330, 50, 70}, 250);
  const auto compared = Compare(before, now);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_THAT(compared->changes, SizeIs(2));
  // The first one is in the middle, about which the picture turns and grows, so that it only moves.
  for (const auto& [u, v] : {std::pair(334.0, 234.0), std::pair(505.0, 365.0)}) {
    EXPECT_TRUE(std::any_of(compared->changes.begin(), compared->changes.end(),
                            [u = u, v = v](const ChangedRegion& region) {
                              return std::abs(region.x + 0.5 * region.width - u) < 20.0 &&
                                     std::abs(region.y + 0.5 * region.height - v) < 20.0 &&
                                     region.width < 120 && region.height < 120;
                            }))
        << u << ", " << v;
  }
}

TEST(Compare, ShowsTheEarlierPictureAsTheLaterCameraSawIt) {
  const PaintedWall wall(1);
  PaintedWall::View same_light = Now();
  same_light.gain = 1.0;
  const GrayImage now = wall.Photograph(same_light);
  const auto compared = Compare(wall.Photograph(Before()), now);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_EQ(compared->earlier.width, kWidth);
  double off = 0.0;
  int count = 0;
  for (int y = 60; y < kHeight - 60; ++y) {
    for (int x = 60; x < kWidth - 60; ++x, ++count) {
      off += std::abs(compared->earlier.at(x, y) - now.at(x, y));
    }
  }
  EXPECT_LT(off / count, 6.0);
}

TEST(Compare, RefusesInWordsPicturesOfOtherPlaces) {
  const auto compared =
      Compare(PaintedWall(1).Photograph(Before()), PaintedWall(2).Photograph(Now()));
  ASSERT_FALSE(compared);
  EXPECT_EQ(compared.error().code, ErrorCode::kConflict);
  EXPECT_THAT(compared.error().message, HasSubstr("do not align"));
}

TEST(Compare, RefusesInWordsAPictureWithoutFeatures) {
  GrayImage dark{kWidth, kHeight, {}};
  dark.pixels.assign(static_cast<std::size_t>(kWidth) * kHeight, 3);
  const auto compared = Compare(PaintedWall(1).Photograph(Before()), dark);
  ASSERT_FALSE(compared);
  EXPECT_THAT(compared.error().message, HasSubstr("0 of their features"));
  EXPECT_EQ(Compare({}, dark).error().code, ErrorCode::kInvalidArgument);
}

TEST(Compare, RefusesInWordsAStripHoweverLongItIs) {
  GrayImage strip{1, 60'000, std::vector<std::uint8_t>(60'000, 90)};
  EXPECT_THAT(Compare(PaintedWall(1).Photograph(Before()), strip).error().message,
              HasSubstr("a strip, of 1x60000 pixels"));
}

// A large change is no part of what is usual.
TEST(Compare, MarksAChangeOfAFifthOfThePicture) {
  const PaintedWall wall(1);
  GrayImage now = wall.Photograph(Now());
  Fill(now, {330, 120, 260, 240}, 250);
  const auto compared = Compare(wall.Photograph(Before()), now);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_FALSE(compared->changes.empty());
  EXPECT_NEAR(compared->changes.front().x + 0.5 * compared->changes.front().width, 460, 60);
}

TEST(Compare, GivesTheChangesOfALargePictureInItsOwnPixels) {
  const PaintedWall wall(1);
  PaintedWall::View close = Before();
  close.scale *= 2.0;
  close.width *= 2;
  close.height *= 2;
  GrayImage large = wall.Photograph(close);
  Fill(large, {500, 400, 160, 120}, 255);
  const auto compared = Compare(wall.Photograph(Before()), large);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_THAT(compared->changes, SizeIs(1));
  EXPECT_NEAR(compared->changes.front().x, 500, 32);
  EXPECT_NEAR(compared->changes.front().width, 160, 64);
  EXPECT_EQ(compared->earlier.width, large.width);
}

}  // namespace
}  // namespace trailcast::photos
