#include "services/lab/trial/path_judge.h"

#include <gtest/gtest.h>

namespace trailcast::trial {
namespace {

TruePath StraightPath(double length_m) {
  TruePath path;
  for (int i = 0; i <= 100; ++i) path.Add({length_m * i / 100.0, 0.0});
  return path;
}

TEST(TruePath, MeasuresTheDistanceToItsNearestPlaceNotItsNearestPoint) {
  TruePath path;
  path.Add({0.0, 0.0});
  path.Add({10.0, 0.0});
  EXPECT_DOUBLE_EQ(path.DistanceTo({5.0, 0.3}), 0.3);
  EXPECT_DOUBLE_EQ(path.DistanceTo({13.0, 4.0}), 5.0);
}

TEST(TruePath, KeepsItsEndEvenWhenTheLastStepWasTooShortToStore) {
  TruePath path;
  path.Add({0.0, 0.0});
  path.Add({0.005, 0.0});
  EXPECT_EQ(path.points_m().size(), 1U);
  EXPECT_DOUBLE_EQ(path.end_m().x(), 0.005);
}

TEST(PathJudge, AConstantOffsetIsMeanAndLargestError) {
  PathJudge judge(StraightPath(10.0));
  for (int i = 0; i <= 100; ++i) judge.Observe({0.1 * i, 0.25});
  const PathVerdict verdict = judge.verdict();
  EXPECT_NEAR(verdict.mean_path_error_m, 0.25, 1e-9);
  EXPECT_NEAR(verdict.max_path_error_m, 0.25, 1e-9);
  EXPECT_NEAR(verdict.final_error_m, 0.25, 1e-9);
  EXPECT_NEAR(verdict.driven_m, 10.0, 1e-9);
}

TEST(PathJudge, NineTenthsAreOfTheMetresDriven) {
  PathJudge judge(StraightPath(10.0));
  for (int i = 0; i <= 100; ++i) judge.Observe({0.1 * i, i > 95 ? 0.5 : 0.1});
  EXPECT_NEAR(judge.verdict().p90_path_error_m, 0.1, 1e-9);
  EXPECT_NEAR(judge.verdict().max_path_error_m, 0.5, 1e-9);
}

TEST(PathJudge, TheStartErrorCountsAsWorstButNotAsLargest) {
  PathJudge judge(StraightPath(10.0));
  for (int i = 0; i <= 100; ++i) {
    const double x_m = 0.1 * i;
    judge.Observe({x_m, std::max(0.0, 0.5 - 0.5 * x_m)});
  }
  const PathVerdict verdict = judge.verdict();
  EXPECT_NEAR(verdict.worst_path_error_m, 0.5, 1e-9);
  EXPECT_NEAR(verdict.max_path_error_m, 0.0, 1e-9);
}

TEST(PathJudge, StandingStillAwayFromThePathDoesNotMoveTheMean) {
  PathJudge judge(StraightPath(10.0));
  for (int i = 0; i <= 50; ++i) judge.Observe({0.1 * i, 0.0});
  for (int i = 0; i <= 10; ++i) judge.Observe({5.0, 0.1 * i});
  const double mean_m = judge.verdict().mean_path_error_m;
  for (int i = 0; i < 1000; ++i) judge.Observe({5.0, 1.0});
  EXPECT_DOUBLE_EQ(judge.verdict().mean_path_error_m, mean_m);
  EXPECT_NEAR(judge.verdict().max_path_error_m, 1.0, 1e-9);
}

TEST(PathJudge, ADriveTooShortToSettleIsJudgedByItsLastPosition) {
  PathJudge judge(StraightPath(10.0));
  judge.Observe({0.0, 0.4});
  judge.Observe({0.5, 0.2});
  EXPECT_NEAR(judge.verdict().max_path_error_m, 0.2, 1e-9);
}

TEST(PathJudge, APushIsNotDrivenAndTheReturnIsMeasuredTenMetresOn) {
  PathJudge judge(StraightPath(20.0));
  for (int i = 0; i <= 50; ++i) judge.Observe({0.1 * i, 0.0});
  judge.NotePush();
  EXPECT_FALSE(judge.verdict().after_push_m.has_value());
  // Back on the path within five metres, then a tenth beside it.
  for (int i = 0; i <= 110; ++i) {
    judge.Observe({5.0 + 0.1 * i, i < 50 ? 2.0 - 0.04 * i : 0.1});
  }
  const PathVerdict verdict = judge.verdict();
  ASSERT_TRUE(verdict.after_push_m.has_value());
  EXPECT_NEAR(*verdict.after_push_m, 0.1, 1e-9);
  EXPECT_NEAR(verdict.worst_path_error_m, 2.0, 1e-9);
  EXPECT_LT(verdict.driven_m, 16.6);  // the two metres of the push are not among them
}

}  // namespace
}  // namespace trailcast::trial
