#include "services/lab/sim/core/plan_view.h"

#include <gtest/gtest.h>

#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::sim {
namespace {

int RedAt(const PlanView& plan, double x_m, double y_m) {
  const Eigen::Vector2d pixel = plan.PixelOf(x_m, y_m);
  const std::size_t i = 3 * image::PixelIndex(static_cast<int>(pixel.x()),
                                              static_cast<int>(pixel.y()), plan.picture.width);
  return plan.picture.pixels[i];
}

TEST(PlanView, ShowsThingsWhereTheyAreAndNoRoof) {
  const auto world = test::SmallWorld()
                         .WhiteBox({2, 1, 0}, {3, 2, 0.5F})
                         .WhiteBox({-9, -9, 2.5F}, {9, 9, 2.6F})
                         .Build();
  const PlanView plan = RenderPlan(*world, {0.05, 1.6});
  EXPECT_EQ(plan.picture.width, 400);
  EXPECT_EQ(plan.picture.height, 400);
  EXPECT_GT(RedAt(plan, 2.5, 1.5), 230);
  EXPECT_NEAR(RedAt(plan, 0.0, 0.0), 100, 3);
  EXPECT_NEAR(RedAt(plan, 2.5, -1.5), 100, 3);
}

TEST(PlanView, IsMadeCoarserRatherThanHuge) {
  const auto world = test::SmallWorld().Build();
  const PlanView plan = RenderPlan(*world, {0.001, 1.6});
  EXPECT_LE(plan.picture.width, 4001);
  EXPECT_GT(plan.metres_per_pixel, 0.004);
}

}  // namespace
}  // namespace trailcast::sim
