#include "services/lab/trial/trial_plot.h"

#include <gmock/gmock.h>

namespace trailcast::trial {
namespace {

using testing::HasSubstr;

TrialOutcome Replayed(const std::string& method, int trial, bool arrived = true) {
  TrialOutcome outcome;
  outcome.row.method = method;
  outcome.row.scout_camera = outcome.row.follower_camera = "webcam";
  outcome.row.trial = trial;
  outcome.row.arrived = arrived;
  outcome.row.state = arrived ? "arrived" : "lost";
  outcome.row.verdict.final_error_m = 0.25;
  outcome.replayed.Add({0.0, 0.1 * trial});
  outcome.replayed.Add({5.0, 0.1 * trial});
  return outcome;
}

TEST(RoughSections, LieAlongTheTaughtPathWhereTheGroundIsNotSmooth) {
  TrialOutcome outcome;
  for (int i = 0; i <= 100; ++i) outcome.taught.Add({0.1 * i, 1.0});
  // By odometry, which is 5 % short, 9.5 m.
  outcome.ground = {{0.0, 3.8, SegmentIndex(0), {0.001, {}, {}}},
                    {3.8, 5.7, SegmentIndex(2), {0.02, {}, {}}},
                    {5.7, 7.6, SegmentIndex(3), {0.01, {}, {}}},
                    {7.6, 9.5, SegmentIndex(4), {0.02, {}, {}}}};
  const auto bands = RoughSections(outcome);
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[0].label, "rough ground");
  EXPECT_TRUE(bands[0].band);
  EXPECT_NEAR(bands[0].points_m.front().x(), 4.0, 0.11);
  EXPECT_NEAR(bands[0].points_m.back().x(), 6.0, 0.11);
  EXPECT_EQ(bands[1].label, "uneven ground");
  EXPECT_EQ(bands[2].label, "") << "named already";
  EXPECT_EQ(bands[2].color, bands[0].color);
}

TEST(ReplayedPaths, NamesEveryReplayOfOneCase) {
  const auto paths = ReplayedPaths({Replayed("default", 1), Replayed("default", 2, false)});
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_THAT(paths[0].label, HasSubstr("trial 1: arrived, 0.25 m from the end"));
  EXPECT_THAT(paths[1].label, HasSubstr("trial 2: lost"));
  EXPECT_NE(paths[0].color, paths[1].color);
  EXPECT_FALSE(paths[0].failed);
  EXPECT_TRUE(paths[1].failed);
}

TEST(ReplayedPaths, GivesEachOfSeveralCasesOneColourAndOneLine) {
  const auto paths = ReplayedPaths({Replayed("default", 1), Replayed("default", 2),
                                    Replayed("paper", 1), Replayed("paper", 2, false)});
  ASSERT_EQ(paths.size(), 4U);
  EXPECT_THAT(paths[0].label, HasSubstr("default  webcam > webcam: 2 of 2 arrived"));
  EXPECT_EQ(paths[1].label, "");
  EXPECT_EQ(paths[1].color, paths[0].color);
  EXPECT_THAT(paths[2].label, HasSubstr("paper    webcam > webcam: 1 of 2 arrived"));
  EXPECT_NE(paths[2].color, paths[0].color);
}

}  // namespace
}  // namespace trailcast::trial
