#include "services/plot/plan_plot.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "services/base/text_file.h"
#include "tests/support/count_near.h"
#include "tests/support/temp_dir.h"

namespace trailcast::plot {
namespace {

using test::CountNear;

Plan TwoPaths() {
  Plan plan;
  plan.title = "two paths";
  plan.paths.push_back({"taught", PathColor(0), {{0.0, 0.0}, {8.0, 0.0}}, true, false});
  plan.paths.push_back({"replayed", PathColor(1), {{0.0, 0.5}, {8.0, 0.5}}, false, false});
  return plan;
}

TEST(AreaAround, HoldsEveryPathWithAMarginAroundIt) {
  const PlanArea area = AreaAround(TwoPaths().paths, 1.0);
  EXPECT_DOUBLE_EQ(area.min_m.x(), -1.0);
  EXPECT_DOUBLE_EQ(area.max_m.x(), 9.0);
  EXPECT_DOUBLE_EQ(area.min_m.y(), -1.0);
  EXPECT_DOUBLE_EQ(area.max_m.y(), 1.5);
}

TEST(AreaAround, NoPathsGiveAnAreaThatCanStillBeDrawn) {
  const PlanArea area = AreaAround({}, 1.0);
  EXPECT_GT(area.size_m().x(), 0.0);
  EXPECT_GT(area.size_m().y(), 0.0);
}

TEST(DrawPlan, ShowsEachPathInItsColour) {
  const Plan plan = TwoPaths();
  const image::RgbImage picture = DrawPlan(plan).Render();
  // The replayed path is 8 m of 10 m wide: hundreds of pixels long, two wide.
  EXPECT_GT(CountNear(picture, plan.paths[1].color), 700);
  Plan without = plan;
  without.paths[1].points_m.clear();
  EXPECT_LT(CountNear(DrawPlan(without).Render(), plan.paths[1].color), 200);
}

TEST(WriteMovingPlan, ADiscDrivesAlongEachPathOneAfterTheOther) {
  const test::TempDir folder;
  Plan plan = TwoPaths();
  plan.paths.push_back({"", PathColor(2), {{0.0, 0.5}, {8.0, 0.5}}, false, false, true});
  ASSERT_TRUE(WriteMovingPlan(plan, {6.0, 2.0}, folder / "plan.svg"));
  const auto text = ReadTextFile(folder / "plan.svg");
  ASSERT_TRUE(text);
  std::size_t discs = 0;
  for (std::size_t at = text->find("<animateMotion"); at != std::string::npos;
       at = text->find("<animateMotion", at + 1)) {
    ++discs;
  }
  EXPECT_EQ(discs, 2U);  // a band is no path that somebody drove
  EXPECT_NE(text->find("keyTimes=\"0;0.0000;0.6000;1\""), std::string::npos) << *text;
  EXPECT_NE(text->find("keyTimes=\"0;0.2000;0.8000;1\""), std::string::npos);
  EXPECT_TRUE(text->substr(text->rfind('<')).starts_with("</svg>"));
}

TEST(WriteMovingPlan, IsAnSvg) {
  const test::TempDir folder;
  EXPECT_FALSE(WriteMovingPlan(TwoPaths(), {}, folder / "plan.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "plan.png"));
}

TEST(DrawPlan, ABandLiesBelowThePaths) {
  Plan plan = TwoPaths();
  const int path = CountNear(DrawPlan(plan).Render(), plan.paths[1].color);
  const image::Color pale{250, 225, 170};
  plan.paths.push_back({"", pale, {{0.0, 0.5}, {8.0, 0.5}}, false, false, true});
  const image::RgbImage picture = DrawPlan(plan).Render();
  EXPECT_GT(CountNear(picture, pale), 3000);
  EXPECT_NEAR(CountNear(picture, plan.paths[1].color), path, 20);
}

TEST(DrawPlan, BothAxesHaveTheSameScale) {
  Plan plan;
  plan.paths.push_back({"", PathColor(0), {{0.0, 0.0}, {18.0, 0.0}}, true, false});
  const image::RgbImage flat = DrawPlan(plan).Render();
  plan.paths.push_back({"", PathColor(1), {{0.0, 0.0}, {0.0, 18.0}}, false, false});
  const image::RgbImage square = DrawPlan(plan).Render();
  EXPECT_EQ(flat.width, square.width);
  // 20 m wide both; 2 m high against 20 m high.
  EXPECT_NEAR(square.height - flat.height, 0.9 * 900.0, 3.0);
}

TEST(DrawPlan, LaysTheWorldUnderThePaths) {
  Plan plan = TwoPaths();
  Backdrop backdrop;
  backdrop.area = {{-1.0, -1.0}, {9.0, 3.0}};
  backdrop.picture = {1, 1, {10, 200, 10}};
  plan.backdrop = backdrop;
  EXPECT_GT(CountNear(DrawPlan(plan).Render(), {10, 200, 10}), 200000);
}

}  // namespace
}  // namespace trailcast::plot
