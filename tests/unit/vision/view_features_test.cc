#include "services/vision/view_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/route/view.h"
#include "services/view/view_table.h"
#include "tests/support/painted_wall.h"
#include "tests/support/walk_frames.h"

namespace trailcast::vision {
namespace {

TEST(DescribeForQuery, GivesDescribedFeaturesInsideThePictureAndNoMoreThanAViewMayHave) {
  const image::GrayImage frame = test::WalkFrame(40, 640, 480);
  const route::View view = DescribeForQuery(frame);
  EXPECT_GT(view.size(), 100U);
  EXPECT_LE(view.size(), route::kMaxViewFeatures);
  for (const route::ViewFeature& feature : view) {
    EXPECT_TRUE(route::IsDescribed(feature.descriptor));
    EXPECT_LT(std::abs(feature.u_px), 320.0F);
    EXPECT_LT(std::abs(feature.v_px), 240.0F);
  }
  EXPECT_EQ(view, DescribeForQuery(frame));
}

TEST(DescribeForQuery, GivesFirstWhatHasNoSizeAndThenFourOctavesOfSizes) {
  const route::View view = DescribeForQuery(test::WalkFrame(40, 640, 480));
  const auto sized = std::find_if(view.begin(), view.end(),
                                  [](const auto& feature) { return feature.size_px > 0.0F; });
  EXPECT_GT(sized - view.begin(), 20);
  EXPECT_LE(sized - view.begin(), 200);
  ASSERT_GT(view.end() - sized, 100);
  const auto [least, most] = std::minmax_element(
      sized, view.end(), [](const auto& a, const auto& b) { return a.size_px < b.size_px; });
  EXPECT_GT(least->size_px, 0.0F);
  EXPECT_GT(most->size_px, 8.0F * least->size_px);
}

TEST(DescribeForQuery, SeesNothingInABlankPicture) {
  EXPECT_TRUE(
      DescribeForQuery({160, 120, std::vector<std::uint8_t>(std::size_t{160} * 120, 90)}).empty());
}

// A frame has the same features as the picture that it is reduced to.
TEST(ViewPicture, ShowsWhatItsFrameDoes) {
  const test::PaintedWall wall(5);
  for (const int enlarged : {1, 2, 4}) {
    const image::GrayImage frame = wall.Photograph(
        {.scale = 1.0 * enlarged, .width = 320 * enlarged, .height = 200 * enlarged});
    ViewPicture reducer;
    const image::GrayImage& picture = reducer.Reduce(frame);
    EXPECT_NEAR(picture.width * picture.height, ViewFeatureOptions{}.pixels, 400);
    ViewDescriber describer;
    const view::ViewTable whole = view::Tabulate(describer.Describe(frame), frame.width);
    const view::ViewTable reduced = view::Tabulate(describer.Describe(picture), picture.width);
    ASSERT_GT(whole.size(), 50U);
    EXPECT_EQ(reduced.bits, whole.bits);
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_NEAR(reduced.u[i], whole.u[i], 1e-4);
      EXPECT_NEAR(reduced.v[i], whole.v[i], 1e-4);
    }
  }
}

TEST(ViewPicture, ASmallFrameIsLeftAsItIs) {
  const image::GrayImage frame = test::PaintedWall(5).Photograph({.width = 160, .height = 120});
  ViewPicture reducer;
  EXPECT_EQ(&reducer.Reduce(frame), &frame);
  const image::GrayImage none;
  EXPECT_EQ(&reducer.Reduce(none), &none);
}

TEST(ViewDescriber, AViewIsRecognisedAtOtherMagnificationsAndResolutions) {
  const test::PaintedWall wall(5);
  ViewDescriber describer;
  const image::GrayImage taught = wall.Photograph({});
  const view::ViewTable key =
      view::Tabulate(view::Spread(describer.Describe(taught), 40), taught.width);
  for (const double scale : {0.7, 0.85, 1.0, 1.2, 1.5}) {
    const image::GrayImage seen =
        wall.Photograph({.scale = scale, .du_px = -12.0, .dv_px = 6.0, .noise_grey = 2.0});
    const view::Comparison match =
        view::Compare(key, view::Tabulate(describer.Describe(seen), seen.width));
    EXPECT_GE(match.agreed(), 8) << "scale " << scale;
    EXPECT_NEAR(match.scale, scale, 0.05 * scale);
    EXPECT_NEAR(0.5 * seen.width * match.shift_u, -12.0, 4.0);
    EXPECT_NEAR(0.5 * seen.width * match.shift_v, 6.0, 4.0);
  }
}

TEST(ViewDescriber, AnotherWallIsNotRecognised) {
  ViewDescriber describer;
  const image::GrayImage taught = test::PaintedWall(5).Photograph({});
  const view::ViewTable key =
      view::Tabulate(view::Spread(describer.Describe(taught), 40), taught.width);
  for (const unsigned other : {77U, 78U, 79U}) {
    const image::GrayImage seen = test::PaintedWall(other).Photograph({.noise_grey = 2.0});
    EXPECT_LT(view::Compare(key, view::Tabulate(describer.Describe(seen), seen.width)).agreed(), 7);
  }
}

TEST(ViewDescriber, PicturesOfAnySizeAndShapeAreLookedAt) {
  ViewDescriber describer;
  for (const auto& [width, height] :
       {std::pair{1, 1}, {7, 300}, {300, 7}, {31, 31}, {64, 48}, {1280, 90}, {1920, 1080}}) {
    const image::GrayImage frame = test::WalkFrame(3, width, height);
    for (const route::ViewFeature& feature : describer.Describe(frame)) {
      EXPECT_LT(std::abs(feature.u_px), 0.5F * static_cast<float>(width));
      EXPECT_LT(std::abs(feature.v_px), 0.5F * static_cast<float>(height));
      EXPECT_GT(feature.size_px, 0.0F);
    }
  }
  EXPECT_TRUE(describer.Describe({}).empty());
}

}  // namespace
}  // namespace trailcast::vision
