#include "agent/follow/keep_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using Time = KeepDistance::Time;

constexpr Time kNow{std::chrono::hours(1)};
constexpr double kSpeed_mps = 0.5;

Neighbour At(const std::string& name, double along_m, double speed_mps = 0.0, double age_s = 0.0) {
  return {AgentId(name), along_m, speed_mps, kNow - FromSeconds(age_s), true};
}

class KeepDistanceTest : public testing::Test {
 protected:
  // Returns what robot "b" does at this place.
  Spacing At5m(const std::vector<Neighbour>& others) {
    return b_.Keep(5.0, kSpeed_mps, others, kNow);
  }
  KeepDistance b_{AgentId("b")};
};

TEST_F(KeepDistanceTest, DrivesAsItWouldAloneWithNobodyAhead) {
  EXPECT_EQ(At5m({}).speed_factor, 1.0);
  EXPECT_EQ(At5m({At("c", 0.0), At("d", 4.5)}).speed_factor, 1.0) << "they are behind";
  EXPECT_EQ(At5m({At("c", 20.0)}).speed_factor, 1.0) << "far ahead";
}

TEST_F(KeepDistanceTest, SlowsDownSmoothlyAndStandsAtTheDistance) {
  double last = 1.0;
  for (double ahead_m = 3.0; ahead_m > 1.52; ahead_m -= 0.05) {
    const Spacing spacing = At5m({At("a", 5.0 + ahead_m)});
    EXPECT_FALSE(spacing.waits_for) << ahead_m;
    EXPECT_LE(spacing.speed_factor, last);
    EXPECT_GT(spacing.speed_factor, last - 0.25) << "no jerk at " << ahead_m;
    last = spacing.speed_factor;
  }
  const Spacing spacing = At5m({At("a", 6.5)});
  EXPECT_EQ(spacing.speed_factor, 0.0);
  ASSERT_TRUE(spacing.waits_for);
  EXPECT_EQ(spacing.waits_for->agent, AgentId("a"));
  EXPECT_NEAR(spacing.ahead_m, 1.5, 1e-9);
}

// A base that changes its speed by no more than 0.5 m/s^2 keeps the distance, too.
TEST_F(KeepDistanceTest, KeepsTheDistanceBehindOneThatStops) {
  for (const double fastest_mps : {0.3, 0.6, 1.0}) {
    KeepDistance keep{AgentId("b")};
    double along_m = 0.0;
    double speed_mps = fastest_mps;
    constexpr double kFrame_s = 1.0 / 30.0;
    for (int frame = 0; frame < 3000; ++frame) {
      const std::array others{At("a", 10.0)};
      const double want_mps =
          fastest_mps * keep.Keep(along_m, fastest_mps, others, kNow).speed_factor;
      speed_mps += std::clamp(want_mps - speed_mps, -0.5 * kFrame_s, 0.5 * kFrame_s);
      along_m += speed_mps * kFrame_s;
    }
    EXPECT_NEAR(along_m, 8.5, 0.02) << fastest_mps;
  }
}

TEST_F(KeepDistanceTest, GoesOnOnlyWhenThereIsRoomAgain) {
  EXPECT_TRUE(At5m({At("a", 6.5)}).waits_for);
  EXPECT_TRUE(At5m({At("a", 6.7)}).waits_for) << "not for every centimetre";
  EXPECT_FALSE(At5m({At("a", 6.9)}).waits_for);
  EXPECT_FALSE(At5m({At("a", 6.7)}).waits_for) << "now that it drives, slowly on";
}

TEST_F(KeepDistanceTest, GoesOnWhenWhoeverWasAheadIsGone) {
  EXPECT_TRUE(At5m({At("a", 6.0)}).waits_for);
  EXPECT_EQ(At5m({}).speed_factor, 1.0);
}

TEST_F(KeepDistanceTest, MindsTheNearestOfSeveral) {
  const Spacing spacing = At5m({At("a", 9.0), At("c", 6.0), At("d", 7.0)});
  ASSERT_TRUE(spacing.waits_for);
  EXPECT_EQ(spacing.waits_for->agent, AgentId("c"));
}

// Each is told the others' places; exactly one may go, whatever the small differences.
TEST_F(KeepDistanceTest, OfThoseAtOnePlaceExactlyOneGoes) {
  const std::vector<std::vector<double>> starts = {
      {0.0, 0.0, 0.0}, {0.0, 0.2, 0.4}, {0.4, 0.2, 0.0}, {0.24, 0.26, 0.25}, {0.1, 0.3, 0.2}};
  const std::array<std::string, 3> names = {"a", "b", "c"};
  for (const auto& start : starts) {
    int going = 0;
    for (std::size_t self = 0; self < names.size(); ++self) {
      std::vector<Neighbour> others;
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (i != self) others.push_back(At(names[i], start[i]));
      }
      KeepDistance keep{AgentId(names[self])};
      going += keep.Keep(start[self], kSpeed_mps, others, kNow).waits_for ? 0 : 1;
    }
    EXPECT_EQ(going, 1) << start[0] << " " << start[1] << " " << start[2];
  }
}

// Side by side at speed, each hears where the other was a moment ago.
TEST_F(KeepDistanceTest, TwoThatDriveSideBySideDoNotBothTakeThemselvesForTheFirst) {
  const std::array to_a{At("b", 4.8, kSpeed_mps, 0.4)};
  const std::array to_b{At("a", 4.8, kSpeed_mps, 0.4)};
  KeepDistance a{AgentId("a")};
  const bool a_waits = a.Keep(5.1, kSpeed_mps, to_a, kNow).waits_for.has_value();
  const bool b_waits = b_.Keep(5.1, kSpeed_mps, to_b, kNow).waits_for.has_value();
  EXPECT_FALSE(a_waits);
  EXPECT_TRUE(b_waits);
}

TEST_F(KeepDistanceTest, CountsFromTheLastPlaceThatWasTold) {
  // By now it may be further, or may have braked at once.
  EXPECT_TRUE(At5m({At("a", 6.45, 1.0, 0.8)}).waits_for);
}

TEST_F(KeepDistanceTest, SaysWhomItWaitsForAndWhenThatOneWasHeard) {
  EXPECT_EQ(WaitText(At5m({At("a", 6.4, 0.0, 0.2)}), kNow), "waits for a, 1.4 m ahead");
  EXPECT_EQ(WaitText(At5m({At("a", 6.4, 0.0, 12.0)}), kNow),
            "waits for a, 1.4 m ahead and not heard for 12 s");
}

}  // namespace
}  // namespace trailcast::agent
