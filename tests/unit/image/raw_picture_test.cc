#include "services/image/raw_picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::image {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;
using Bytes = std::vector<std::uint8_t>;

RawPicture Picture(const std::string& encoding, std::uint32_t width, std::uint32_t height,
                   std::uint32_t step, const Bytes& bytes) {
  return {
      .width_px = width, .height_px = height, .encoding = encoding, .step = step, .bytes = bytes};
}

Result<GrayImage> Gray(const RawPicture& picture) {
  PictureRun alone;
  return GrayFromRaw(picture, alone);
}

TEST(GrayFromRaw, TakesGreyAsItIsWithoutTheRowsPadding) {
  const Bytes bytes{1, 2, 99, 3, 4};  // the last row's padding may be missing
  const auto gray = Gray(Picture("mono8", 2, 2, 3, bytes));
  ASSERT_TRUE(gray) << gray.error().message;
  EXPECT_EQ(gray->width, 2);
  EXPECT_EQ(gray->height, 2);
  EXPECT_THAT(gray->pixels, ElementsAre(1, 2, 3, 4));
}

TEST(GrayFromRaw, TakesTheUpperByteOfSixteenBits) {
  const Bytes bytes{0x34, 0x12, 0x78, 0x56};
  RawPicture picture = Picture("mono16", 2, 1, 4, bytes);
  EXPECT_THAT(Gray(picture).value().pixels, ElementsAre(0x12, 0x56));
  picture.big_endian = true;
  EXPECT_THAT(Gray(picture).value().pixels, ElementsAre(0x34, 0x78));
}

// Two pixels of 16 bits.
Bytes Two(unsigned a, unsigned b) {
  Bytes bytes;
  for (const unsigned number : {a, b}) {
    bytes.push_back(static_cast<std::uint8_t>(number));
    bytes.push_back(static_cast<std::uint8_t>(number >> 8U));
  }
  return bytes;
}

TEST(GrayFromRaw, OfASensorWithFewerBitsThoseAreTaken) {
  for (const unsigned bits : {10U, 12U, 14U, 16U}) {
    PictureRun run;
    const Bytes bright = Two((1U << bits) - 1, 1U << (bits - 1));
    EXPECT_THAT(GrayFromRaw(Picture("mono16", 2, 1, 4, bright), run).value().pixels,
                ElementsAre(255, 128))
        << bits;
    EXPECT_EQ(run.TakeNews().size(), bits == 16 ? 0U : 1U) << bits;
    // A darker picture is no brighter afterwards.
    const Bytes dark = Two(3U << (bits - 8), 0);
    EXPECT_THAT(GrayFromRaw(Picture("16UC1", 2, 1, 4, dark), run).value().pixels, ElementsAre(3, 0))
        << bits;
    EXPECT_THAT(run.TakeNews(), testing::IsEmpty()) << bits;
  }
}

TEST(GrayFromRaw, ASensorThatTurnsOutToHaveMoreBitsIsTold) {
  PictureRun run;
  const Bytes dark = Two(1000, 0);
  EXPECT_THAT(GrayFromRaw(Picture("mono16", 2, 1, 4, dark), run).value().pixels,
              ElementsAre(250, 0));
  EXPECT_THAT(run.TakeNews(), ElementsAre(HasSubstr("10 of their 16 bits")));
  const Bytes bright = Two(4000, 1000);
  EXPECT_THAT(GrayFromRaw(Picture("mono16", 2, 1, 4, bright), run).value().pixels,
              ElementsAre(250, 62));
  EXPECT_THAT(run.TakeNews(), ElementsAre(HasSubstr("12 of their 16 bits, no longer 10")));
}

TEST(GrayFromRaw, WeighsColoursByTheirBrightness) {
  const Bytes red{255, 0, 0};
  EXPECT_THAT(Gray(Picture("rgb8", 1, 1, 3, red)).value().pixels, ElementsAre(76));
  EXPECT_THAT(Gray(Picture("bgr8", 1, 1, 3, red)).value().pixels, ElementsAre(29));
  const Bytes red_alpha{255, 0, 0, 7};
  EXPECT_THAT(Gray(Picture("rgba8", 1, 1, 4, red_alpha)).value().pixels, ElementsAre(76));
  EXPECT_THAT(Gray(Picture("bgra8", 1, 1, 4, red_alpha)).value().pixels, ElementsAre(29));
}

TEST(GrayFromRaw, TakesTheBrightnessOfYuv) {
  const Bytes uyvy{128, 10, 128, 20};
  EXPECT_THAT(Gray(Picture("yuv422", 2, 1, 4, uyvy)).value().pixels, ElementsAre(10, 20));
  const Bytes yuyv{10, 128, 20, 128};
  EXPECT_THAT(Gray(Picture("yuv422_yuy2", 2, 1, 4, yuyv)).value().pixels, ElementsAre(10, 20));
}

// Red light on a sensor: only the pixels under its red filters see it.
TEST(GrayFromRaw, KnowsWhereABayerPatternHasItsRed) {
  constexpr std::uint32_t kSide = 8;
  const auto red_light = [](std::uint32_t red_x, std::uint32_t red_y) {
    Bytes bytes(kSide * kSide, 0);
    for (std::uint32_t y = red_y; y < kSide; y += 2) {
      for (std::uint32_t x = red_x; x < kSide; x += 2) bytes[y * kSide + x] = 200;
    }
    return bytes;
  };
  const auto gray = [](const std::string& encoding, const Bytes& bytes) {
    return Gray(Picture(encoding, kSide, kSide, kSide, bytes)).value().pixels;
  };
  // 0.299 of 200; of blue it would be 0.114.
  EXPECT_THAT(gray("bayer_rggb8", red_light(0, 0)), Each(AllOf(Ge(58), Le(61))));
  EXPECT_THAT(gray("bayer_grbg8", red_light(1, 0)), Each(AllOf(Ge(58), Le(61))));
  EXPECT_THAT(gray("bayer_gbrg8", red_light(0, 1)), Each(AllOf(Ge(58), Le(61))));
  EXPECT_THAT(gray("bayer_bggr8", red_light(1, 1)), Each(AllOf(Ge(58), Le(61))));
}

TEST(GrayFromRaw, RefusesWhatItDoesNotUnderstandAndNamesWhatItDoes) {
  const Bytes bytes(64);
  EXPECT_THAT(Gray(Picture("32FC1", 4, 4, 16, bytes)).error().message,
              AllOf(HasSubstr("32FC1"), HasSubstr("mono8"), HasSubstr("bayer_rggb8")));
}

TEST(GrayFromRaw, RefusesSizesThatDoNotAddUp) {
  const Bytes bytes(12);
  EXPECT_FALSE(Gray(Picture("mono8", 0, 3, 4, bytes)));
  EXPECT_FALSE(Gray(Picture("mono8", 4, 0, 4, bytes)));
  EXPECT_FALSE(Gray(Picture("mono8", 4, 4, 4, bytes)));
  EXPECT_FALSE(Gray(Picture("mono8", 4, 3, 3, bytes)));
  EXPECT_FALSE(Gray(Picture("mono8", 70'000, 1, 70'000, bytes)));
  EXPECT_FALSE(Gray(Picture("rgb8", 4, 3, 4'294'967'295U, bytes)));
}

}  // namespace
}  // namespace trailcast::image
