#include "services/plot/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "services/image/files.h"
#include "tests/support/temp_dir.h"

namespace trailcast::plot {
namespace {

using image::Color;
using testing::HasSubstr;
using testing::StartsWith;

constexpr Color kWhite = {255, 255, 255};
constexpr Color kRed = {255, 0, 0};

Color At(const image::RgbImage& picture, int x, int y) {
  const auto i = 3 * image::PixelIndex(x, y, picture.width);
  return {picture.pixels[i], picture.pixels[i + 1], picture.pixels[i + 2]};
}

TEST(Drawing, FillsAndOutlinesBoxes) {
  Drawing filled(20, 20, kWhite);
  filled.FillBox({5, 5}, {15, 12}, kRed);
  EXPECT_EQ(At(filled.Render(), 10, 8), kRed);
  EXPECT_EQ(At(filled.Render(), 10, 16), kWhite);
  Drawing outlined(20, 20, kWhite);
  outlined.OutlineBox({4, 4}, {16, 15}, kRed, 3.0);
  const image::RgbImage picture = outlined.Render();
  EXPECT_EQ(At(picture, 10, 10), kWhite);
  for (const auto& [x, y] :
       {std::pair(10, 4), std::pair(10, 15), std::pair(4, 10), std::pair(16, 10)}) {
    EXPECT_EQ(At(picture, x, y), kRed) << x << ", " << y;
  }
}

TEST(Drawing, DashedLineLeavesGapsThatAFullLineDoesNot) {
  const auto painted = [](bool dashed) {
    Drawing drawing(100, 9, kWhite);
    drawing.Line({{0, 4}, {40, 4}, {99, 4}}, kRed, 1.0, dashed);
    const image::RgbImage picture = drawing.Render();
    int count = 0;
    for (int x = 0; x < 100; ++x) count += At(picture, x, 4)[2] < 128 ? 1 : 0;
    return count;
  };
  EXPECT_GE(painted(false), 98);
  EXPECT_GT(painted(true), 35);
  EXPECT_LT(painted(true), 75);
}

TEST(Drawing, DiscAndCrossMarkTheirCentre) {
  Drawing drawing(40, 20, kWhite);
  drawing.Disc({10, 10}, 4.0, kRed);
  drawing.Cross({30, 10}, 5.0, kRed, 2.0);
  const image::RgbImage picture = drawing.Render();
  EXPECT_EQ(At(picture, 10, 10), kRed);
  EXPECT_EQ(At(picture, 10, 16), kWhite);
  EXPECT_EQ(At(picture, 30, 10), kRed);
  EXPECT_EQ(At(picture, 30, 3), kWhite);
}

TEST(Drawing, CapitalsHaveTheHeightAskedForAndTextItsWidth) {
  Drawing drawing(300, 100, kWhite);
  drawing.Text("HIM", {20, 70}, 40.0, {0, 0, 0});
  const image::RgbImage picture = drawing.Render();
  int top = 100;
  int bottom = 0;
  int right = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 300; ++x) {
      if (At(picture, x, y)[0] > 128) continue;
      top = std::min(top, y);
      bottom = std::max(bottom, y);
      right = std::max(right, x);
    }
  }
  EXPECT_NEAR(bottom, 69, 2);
  EXPECT_NEAR(bottom - top, 39, 3);
  EXPECT_NEAR(right, 20 + Drawing::TextWidth("HIM", 40.0), 8);
}

TEST(Drawing, PasteScalesAndIsCutAtTheBorder) {
  const image::RgbImage small{2, 2, {255, 0, 0, 255, 0, 0, 255, 0, 0, 255, 0, 0}};
  Drawing drawing(20, 20, kWhite);
  drawing.Paste(small, 15, -3, 10, 10);
  const image::RgbImage picture = drawing.Render();
  EXPECT_EQ(At(picture, 18, 2), kRed);
  EXPECT_EQ(At(picture, 13, 3), kWhite);
  EXPECT_EQ(At(picture, 17, 9), kWhite);
}

TEST(Drawing, IsWrittenAsPixelsOrAsVectorsByTheFilesName) {
  const test::TempDir folder;
  Drawing drawing(30, 20, kWhite);
  drawing.Disc({10, 10}, 6.0, kRed);
  ASSERT_TRUE(drawing.Write(folder / "a.png"));
  const auto read = image::ReadRgb(folder / "a.png");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->pixels, drawing.Render().pixels);
  ASSERT_TRUE(drawing.Write(folder / "a.svg"));
  std::ostringstream text;
  text << std::ifstream(folder / "a.svg").rdbuf();
  EXPECT_THAT(text.str(), StartsWith("<?xml"));
  EXPECT_THAT(text.str(), HasSubstr("<path"));
  const auto nowhere = drawing.Write(folder / "absent" / "a.png");
  ASSERT_FALSE(nowhere);
  EXPECT_THAT(nowhere.error().message, HasSubstr("absent/a.png"));
  EXPECT_FALSE(drawing.Write(folder / "absent" / "a.svg"));
}

}  // namespace
}  // namespace trailcast::plot
