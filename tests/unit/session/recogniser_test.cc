#include "agent/session/src/place/recogniser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/painted_wall.h"

namespace trailcast::agent {
namespace {

std::vector<route::KeyView> ViewsOf(const std::vector<unsigned>& walls) {
  vision::ViewDescriber describer;
  std::vector<route::KeyView> views;
  for (const unsigned wall : walls) {
    views.push_back(
        {0.0, view::Spread(describer.Describe(test::PaintedWall(wall).Photograph({})), 40)});
  }
  return views;
}

TEST(Recogniser, TellsWhichViewsAreSeenAndHowTheyMapOntoThePicture) {
  Recogniser recogniser(320);
  recogniser.Learn(ViewsOf({5, 6}));
  recogniser.Learn(ViewsOf({7}));
  const image::GrayImage frame =
      test::PaintedWall(7).Photograph({.scale = 1.2, .du_px = 10.0, .noise_grey = 2.0});
  vision::ViewPicture reducer;
  const image::GrayImage& reduced = reducer.Reduce(frame);
  ASSERT_LT(reduced.width, frame.width);
  for (const image::GrayImage* picture : {&frame, &reduced}) {
    const Look look = recogniser.LookAt(*picture, frame.width, std::vector<std::size_t>{0, 2});
    ASSERT_EQ(recogniser.Compared(look).size(), 2U);
    EXPECT_LT(recogniser.Compared(look)[0].agreed, 7);
    EXPECT_GE(recogniser.Compared(look)[1].agreed, 10);
    ASSERT_NE(look.Best(), nullptr);
    EXPECT_EQ(look.Best()->view, 2U);
    const vision::ViewFit fit = recogniser.FitOf(look, look.Best()->comparison);
    EXPECT_NEAR(fit.scale, 1.2, 0.04);
    EXPECT_NEAR(fit.du_px, 10.0, 3.0);
  }
}

TEST(Recogniser, HowAPlaceLookedLaterSaysNothingOfHowThingsGrowOnTheWay) {
  const auto nearer = [](unsigned wall, double scale) {
    vision::ViewDescriber describer;
    return view::Spread(
        describer.Describe(test::PaintedWall(wall).Photograph({.scale = scale, .du_px = 3.0})), 40);
  };
  Recogniser recogniser(320);
  const auto growths = recogniser.Learn(std::vector<route::KeyView>{
      {0.0, nearer(5, 1.0)}, {0.0, nearer(6, 1.0), std::uint8_t{0}}, {0.5, nearer(5, 1.1)}});
  ASSERT_EQ(growths.size(), 3U);
  EXPECT_FALSE(growths[1]);
  ASSERT_TRUE(growths[2]);
  EXPECT_NEAR(*growths[2], std::log(1.1), 0.02);
}

TEST(Recogniser, NothingToCompareIsNothingSeen) {
  Recogniser recogniser(320);
  const Look look = recogniser.LookAt(test::PaintedWall(7).Photograph({}), 320, {});
  EXPECT_TRUE(recogniser.Compared(look).empty());
  EXPECT_EQ(look.Best(), nullptr);
}

}  // namespace
}  // namespace trailcast::agent
