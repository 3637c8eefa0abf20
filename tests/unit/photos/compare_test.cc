#include "services/photos/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace trailcast::photos {
namespace {

using image::GrayImage;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr int kWidth = 640;
constexpr int kHeight = 480;

struct Box {
  int x, y, width, height;
};

void Fill(GrayImage& picture, const Box& box, int grey) {
  for (int y = std::max(0, box.y); y < std::min(picture.height, box.y + box.height); ++y) {
    for (int x = std::max(0, box.x); x < std::min(picture.width, box.x + box.width); ++x) {
      picture.pixels[image::PixelIndex(x, y, picture.width)] = static_cast<std::uint8_t>(grey);
    }
  }
}

// A wall of boxes, larger than what a camera sees of it.
GrayImage Wall(unsigned seed) {
  constexpr int kMargin = 200;
  GrayImage wall{kWidth + kMargin, kHeight + kMargin, {}};
  wall.pixels.assign(static_cast<std::size_t>(wall.width) * wall.height, 110);
  std::mt19937 draw(seed);
  const auto within = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(draw);
  };
  for (int i = 0; i < 700; ++i) {
    Fill(wall, {within(0, wall.width), within(0, wall.height), within(6, 50), within(6, 50)},
         within(30, 220));
  }
  return wall;
}

struct Camera {
  double x = 100.0;  // of its picture's corner on the wall
  double y = 100.0;
  double turned_rad = 0.0;
  double gain = 1.0;
  double offset = 0.0;
  double noise = 2.0;
  unsigned seed = 1;
};

GrayImage Seen(const GrayImage& wall, const Camera& camera) {
  GrayImage picture{kWidth, kHeight, {}};
  std::mt19937 draw(camera.seed);
  std::normal_distribution<double> noise(0.0, camera.noise);
  const double c = std::cos(camera.turned_rad);
  const double s = std::sin(camera.turned_rad);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double x = camera.x + c * u - s * v;
      const double y = camera.y + s * u + c * v;
      const int left = std::clamp(static_cast<int>(x), 0, wall.width - 2);
      const int top = std::clamp(static_cast<int>(y), 0, wall.height - 2);
      const double fx = std::clamp(x - left, 0.0, 1.0);
      const double fy = std::clamp(y - top, 0.0, 1.0);
      const double grey = (1 - fy) * ((1 - fx) * wall.at(left, top) + fx * wall.at(left + 1, top)) +
                          fy * ((1 - fx) * wall.at(left, top + 1) + fx * wall.at(left + 1, top + 1));
      picture.pixels.push_back(static_cast<std::uint8_t>(
          std::clamp(camera.gain * grey + camera.offset + noise(draw), 0.0, 255.0)));
    }
  }
  return picture;
}

const Camera kBefore{};
// It stands elsewhere, has turned, and there is less light.
const Camera kNow{.x = 112.0, .y = 95.0, .turned_rad = 0.03, .gain = 0.75, .offset = 8.0, .seed = 2};

TEST(Compare, MarksNothingWhereNothingHasChanged) {
  const GrayImage wall = Wall(1);
  const auto compared = Compare(Seen(wall, kBefore), Seen(wall, kNow));
  ASSERT_TRUE(compared) << compared.error().message;
  EXPECT_THAT(compared->changes, IsEmpty());
  EXPECT_GT(compared->overlap, 0.9);
  EXPECT_GT(compared->agreeing, 100);
}

TEST(Compare, MarksWhatHasComeAndWhatHasGone) {
  GrayImage before = Wall(1);
  GrayImage now = before;
  Fill(before, {250, 200, 60, 40}, 240);  // a box that is taken away
  Fill(now, {500, 380, 50, 70}, 15);      // and one that is put there
  const auto compared = Compare(Seen(before, kBefore), Seen(now, kNow));
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_THAT(compared->changes, SizeIs(2));
  // Where a place on the wall is in the later picture.
  const auto at = [](double x, double y) {
    const double dx = x - kNow.x;
    const double dy = y - kNow.y;
    const double c = std::cos(kNow.turned_rad);
    const double s = std::sin(kNow.turned_rad);
    return std::pair(c * dx + s * dy, -s * dx + c * dy);
  };
  for (const auto& [x, y] : {at(280.0, 220.0), at(525.0, 415.0)}) {
    EXPECT_TRUE(std::any_of(compared->changes.begin(), compared->changes.end(),
                            [u = x, v = y](const ChangedRegion& region) {
                              return std::abs(region.x + 0.5 * region.width - u) < 8.0 &&
                                     std::abs(region.y + 0.5 * region.height - v) < 8.0 &&
                                     region.width < 100 && region.height < 100;
                            }))
        << x << ", " << y;
  }
}

TEST(Compare, ShowsTheEarlierPictureAsTheLaterCameraSawIt) {
  const GrayImage wall = Wall(1);
  Camera same_light = kNow;
  same_light.gain = 1.0;
  same_light.offset = 0.0;
  const GrayImage now = Seen(wall, same_light);
  const auto compared = Compare(Seen(wall, kBefore), now);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_EQ(compared->earlier.width, kWidth);
  double off = 0.0;
  int count = 0;
  for (int y = 60; y < kHeight - 60; ++y) {
    for (int x = 60; x < kWidth - 60; ++x, ++count) {
      off += std::abs(compared->earlier.at(x, y) - now.at(x, y));
    }
  }
  EXPECT_LT(off / count, 8.0);
}

TEST(Compare, RefusesInWordsPicturesOfOtherPlaces) {
  const auto compared = Compare(Seen(Wall(1), kBefore), Seen(Wall(2), kNow));
  ASSERT_FALSE(compared);
  EXPECT_EQ(compared.error().code, ErrorCode::kConflict);
  EXPECT_THAT(compared.error().message, HasSubstr("do not align"));
}

TEST(Compare, RefusesInWordsAPictureWithoutFeatures) {
  GrayImage dark{kWidth, kHeight, {}};
  dark.pixels.assign(static_cast<std::size_t>(kWidth) * kHeight, 3);
  const auto compared = Compare(Seen(Wall(1), kBefore), dark);
  ASSERT_FALSE(compared);
  EXPECT_THAT(compared.error().message, HasSubstr("0 of their features"));
  EXPECT_EQ(Compare({}, dark).error().code, ErrorCode::kInvalidArgument);
}

TEST(Compare, TakesLargePicturesOfAnySize) {
  const GrayImage wall = Wall(1);
  const GrayImage small = Seen(wall, kBefore);
  GrayImage large{2 * kWidth, 2 * kHeight, {}};
  for (int y = 0; y < large.height; ++y) {
    for (int x = 0; x < large.width; ++x) large.pixels.push_back(small.at(x / 2, y / 2));
  }
  Fill(large, {500, 400, 160, 120}, 255);
  const auto compared = Compare(small, large);
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_THAT(compared->changes, SizeIs(1));
  EXPECT_NEAR(compared->changes.front().x, 500, 16);
  EXPECT_NEAR(compared->changes.front().width, 160, 32);
  EXPECT_EQ(compared->earlier.width, large.width);
}

}  // namespace
}  // namespace trailcast::photos
