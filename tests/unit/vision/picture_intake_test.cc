#include "services/vision/picture_intake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "services/base/angles.h"

namespace trailcast::vision {
namespace {

// Grey 60, with a bright spot as large as a share of the picture around (u, v), from its centre in
// shares of its width.
image::GrayImage Spot(int width, int height, double u, double v) {
  image::GrayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double du = (x - 0.5 * (width - 1)) / width - u;
      const double dv = (y - 0.5 * (height - 1)) / width - v;
      image.pixels.push_back(std::hypot(du, dv) < 0.03 ? 220 : 60);
    }
  }
  return image;
}

struct Place {
  double u = 0.0;  // from the centre, in pixels
  double v = 0.0;
};

Place SpotIn(const image::GrayImage& image) {
  Place sum;
  double weight = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (image.at(x, y) < 140) continue;
      sum.u += x - 0.5 * (image.width - 1);
      sum.v += y - 0.5 * (image.height - 1);
      weight += 1.0;
    }
  }
  return {sum.u / weight, sum.v / weight};
}

TEST(PictureIntake, LeavesAnUprightPictureOfUsualSizeAlone) {
  PictureIntake intake;
  const image::GrayImage frame = Spot(640, 480, 0.1, 0.1);
  EXPECT_EQ(&intake.Take(frame), &frame);
}

TEST(PictureIntake, ReducesLargePicturesAboutTheirCentre) {
  for (const auto& [width, height] : {std::pair(1280, 720), {1920, 1080}, {1000, 1400}}) {
    PictureIntake intake;
    const image::GrayImage frame = Spot(width, height, 0.2, -0.1);
    const image::GrayImage& taken = intake.Take(frame);
    EXPECT_EQ(std::max(taken.width, taken.height), 640);
    EXPECT_NEAR(static_cast<double>(taken.height) / taken.width,
                static_cast<double>(height) / width, 0.002);
    EXPECT_NEAR(SpotIn(taken).u, 0.2 * taken.width, 0.3);
    EXPECT_NEAR(SpotIn(taken).v, -0.1 * taken.width, 0.3);
    const PictureSize size = WorkingSize({width, height});
    EXPECT_EQ(size.width, taken.width);
    EXPECT_EQ(size.height, taken.height);
  }
}

// A camera that is rolled clockwise sees things further counter-clockwise in its picture.
TEST(PictureIntake, TurnsPicturesUprightByAnyRollThatItAccepts) {
  constexpr double kRight = 0.15;
  constexpr double kDown = 0.05;  // of the spot, seen upright
  for (const double roll_deg : {-90.0, -8.0, 3.0, 12.0, 90.0, 95.0, 180.0, 185.0, 270.0, 360.0}) {
    ASSERT_TRUE(CheckRoll(roll_deg));
    const double cosine = std::cos(Radians(roll_deg));
    const double sine = std::sin(Radians(roll_deg));
    const image::GrayImage frame =
        Spot(400, 300, cosine * kRight + sine * kDown, cosine * kDown - sine * kRight);
    const IntakeOptions options{.roll_deg = roll_deg};
    PictureIntake intake(options);
    const image::GrayImage& taken = intake.Take(frame);
    EXPECT_NEAR(SpotIn(taken).u, 400 * kRight, 0.6) << roll_deg;
    EXPECT_NEAR(SpotIn(taken).v, 400 * kDown, 0.6) << roll_deg;
    const PictureSize size = WorkingSize({400, 300}, options);
    EXPECT_EQ(size.width, taken.width) << roll_deg;
    EXPECT_EQ(size.height, taken.height) << roll_deg;
  }
}

TEST(PictureIntake, OfASmallRollNothingIsLeftThatTheCameraDidNotSee) {
  const image::GrayImage white{400, 300, std::vector<std::uint8_t>(400 * 300, 200)};
  image::GrayImage framed = white;
  for (int x = 0; x < 400; ++x) framed.pixels[image::PixelIndex(x, 0, 400)] = 0;
  for (int y = 0; y < 300; ++y) framed.pixels[image::PixelIndex(399, y, 400)] = 0;
  PictureIntake intake({.roll_deg = 15.0});
  const image::GrayImage& taken = intake.Take(framed);
  EXPECT_GT(taken.width, 250);
  int touched = 0;
  for (const std::uint8_t pixel : taken.pixels) touched += pixel < 190 ? 1 : 0;
  EXPECT_LT(touched, 4);  // its corners touch the frame's edge
}

TEST(PictureIntake, RefusesARollThatLeavesNoUprightPicture) {
  for (const double roll_deg : {45.0, 21.0, -130.0, 1000.0, std::nan("")}) {
    const auto checked = CheckRoll(roll_deg);
    ASSERT_FALSE(checked) << roll_deg;
    EXPECT_NE(checked.error().message.find("0, 90, 180 or 270"), std::string::npos);
  }
}

}  // namespace
}  // namespace trailcast::vision
