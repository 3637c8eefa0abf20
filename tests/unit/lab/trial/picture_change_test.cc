#include "services/lab/trial/recording/picture_change.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/support/painted_wall.h"

namespace trailcast::trial {
namespace {

image::GrayImage Wall() { return test::PaintedWall(5).Photograph({.width = 160, .height = 120}); }

image::GrayImage Apply(const std::string& disturbance, image::GrayImage frame, int number = 0,
                       std::uint64_t seed = 1) {
  auto changed =
      PictureChanger(*ParseDisturbance(disturbance), seed).Apply(std::move(frame), number);
  if (!changed) throw std::runtime_error(changed.error().message);
  return std::move(*changed);
}

// Root of the mean squared difference, over the pixels where `where` says so.
template <typename Where>
double Rms(const image::GrayImage& one, const image::GrayImage& other, const Where& where) {
  double sum = 0.0;
  int count = 0;
  for (int y = 0; y < one.height; ++y) {
    for (int x = 0; x < one.width; ++x) {
      if (!where(x, y)) continue;
      sum += std::pow(one.at(x, y) - other.at(x, y), 2);
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}
double Rms(const image::GrayImage& one, const image::GrayImage& other) {
  return Rms(one, other, [](int, int) { return true; });
}

double Brightness(const image::GrayImage& picture) {
  double sum = 0.0;
  for (const std::uint8_t level : picture.pixels) sum += level;
  return sum / static_cast<double>(picture.pixels.size());
}

// Between neighbours in a row, in the mean.
double Contrast(const image::GrayImage& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 1; x < picture.width; ++x) {
      sum += std::abs(picture.at(x, y) - picture.at(x - 1, y));
    }
  }
  return sum / static_cast<double>(picture.pixels.size());
}

TEST(PictureChange, ChangesOfTheOrderLeavePicturesAlone) {
  EXPECT_EQ(Apply("every=3+slower+reverse+skip+jump", Wall()).pixels, Wall().pixels);
}

TEST(PictureChange, NoiseIsAsStrongAsAskedFor) {
  const image::GrayImage grey{160, 120, std::vector<std::uint8_t>(19200, 128)};
  EXPECT_NEAR(Rms(Apply("noise=12", grey), grey), 12.0, 0.5);
}

TEST(PictureChange, EachPicturesNoiseIsItsOwn) {
  const image::GrayImage grey{160, 120, std::vector<std::uint8_t>(19200, 128)};
  const image::GrayImage first = Apply("noise=12", grey, 0);
  EXPECT_EQ(Apply("noise=12", grey, 0).pixels, first.pixels);
  // Independent ones differ by the root of two.
  EXPECT_NEAR(Rms(Apply("noise=12", grey, 1), first), 17.0, 0.7);
  EXPECT_NEAR(Rms(Apply("noise=12", grey, 0, 2), first), 17.0, 0.7);
}

TEST(PictureChange, JpegLosesMoreAtLowerQuality) {
  const double good = Rms(Apply("jpeg=95", Wall()), Wall());
  const double bad = Rms(Apply("jpeg=10", Wall()), Wall());
  EXPECT_GT(good, 0.0);
  EXPECT_GT(bad, 2.0 * good);
  EXPECT_LT(bad, 20.0);
}

TEST(PictureChange, ASmearIsInOnePlaceOfTheLens) {
  const image::GrayImage wall = Wall();
  const image::GrayImage smeared = Apply("smear=0.2", wall, 0);
  EXPECT_EQ(Apply("smear=0.2", wall, 7).pixels, smeared.pixels);  // and stays there
  EXPECT_NE(Apply("smear=0.2", wall, 0, 2).pixels, smeared.pixels);
  int changed = 0;
  for (std::size_t i = 0; i < smeared.pixels.size(); ++i) {
    changed += smeared.pixels[i] != wall.pixels[i] ? 1 : 0;
  }
  // A disc of 32 pixels is 3217 of 19200; its edge is soft.
  EXPECT_GT(changed, 2000);
  EXPECT_LT(changed, 7000);
}

TEST(PictureChange, MotionBlurIsOfAnotherLengthInEachPictureAndKeepsBrightness) {
  const image::GrayImage wall = Wall();
  const image::GrayImage blurred = Apply("blur=0.1", wall, 3);
  EXPECT_EQ(Apply("blur=0.1", wall, 3).pixels, blurred.pixels);
  EXPECT_NE(Apply("blur=0.1", wall, 4).pixels, blurred.pixels);
  EXPECT_NEAR(Brightness(blurred), Brightness(wall), 2.0);
  double least = Contrast(wall);
  for (int number = 0; number < 10; ++number) {
    least = std::min(least, Contrast(Apply("blur=0.2", wall, number)));
  }
  EXPECT_LT(least, 0.8 * Contrast(wall)) << "the longest of them";
}

TEST(PictureChange, AFlareBurnsOutADiscThatWandersAndPalesTheRest) {
  const image::GrayImage wall = Wall();
  const image::GrayImage before = Apply("flare=0.7", wall, 0);
  const image::GrayImage later = Apply("flare=0.7", wall, 30);
  const auto burnt = [](const image::GrayImage& picture) {
    return std::count(picture.pixels.begin(), picture.pixels.end(), 255);
  };
  // A disc of 8 pixels is 201, or half of it at the picture's edge.
  EXPECT_GT(burnt(before), 100);
  EXPECT_LT(burnt(before), 6000);
  EXPECT_GT(burnt(later), 100);
  EXPECT_NE(before.pixels, later.pixels);
  EXPECT_LT(Contrast(before), Contrast(wall));
  EXPECT_GT(Brightness(before), 0.6 * Brightness(wall));
}

TEST(PictureChange, ACropTakesFromOneSide) {
  const image::GrayImage cropped = Apply("crop=0.25", Wall());
  ASSERT_EQ(cropped.width, 120);
  ASSERT_EQ(cropped.height, 90);
  EXPECT_EQ(cropped.at(0, 0), Wall().at(40, 0));
  EXPECT_EQ(cropped.at(119, 89), Wall().at(159, 89));
}

TEST(PictureChange, AnotherCameraHasMorePixels) {
  const image::GrayImage seen = Apply("camera", Wall());
  EXPECT_EQ(seen.width, 200);
  EXPECT_EQ(seen.height, 150);
}

TEST(PictureChange, SeveralAreDoneOneAfterTheOther) {
  EXPECT_EQ(Apply("crop=0.25+gamma=2", Wall()).pixels,
            Apply("gamma=2", Apply("crop=0.25", Wall())).pixels);
  EXPECT_EQ(Apply("crop=0.25+camera", Wall()).width, 150);
}

}  // namespace
}  // namespace trailcast::trial
