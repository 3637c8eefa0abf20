#include "services/odometry/turn_series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trailcast::odometry {
namespace {

// To the left and back within three seconds, so much later.
std::vector<TimedValue> Turn(double rate_hz, double late_s, double scale) {
  std::vector<TimedValue> series;
  for (double t_s = 0.0; t_s < 5.0; t_s += 1.0 / rate_hz) {
    const double into_s = std::clamp(t_s - 1.0 - late_s, 0.0, 3.0);
    series.push_back({t_s, scale * std::min(into_s, 3.0 - into_s)});
  }
  return series;
}

TEST(LagOf, IsHowMuchLaterTheOneTurns) {
  const auto odometry = Turn(50.0, 0.0, 0.4);
  for (const double late_s : {-0.3, 0.0, 0.12, 0.4}) {
    const auto lag = LagOf(Turn(30.0, late_s, -0.2), odometry);
    ASSERT_TRUE(lag) << late_s;
    EXPECT_NEAR(lag->s, late_s, 0.021);
    EXPECT_LT(lag->correlation, -0.9);
  }
}

TEST(LagOf, IsNotKnownWhereNothingTurnsOrTheyHaveNothingToDoWithEachOther) {
  const auto odometry = Turn(50.0, 0.0, 0.4);
  EXPECT_FALSE(LagOf(Turn(30.0, 0.0, 0.0), odometry));
  EXPECT_FALSE(LagOf(odometry, {}));
  std::vector<TimedValue> other;
  for (double t_s = 0.0; t_s < 5.0; t_s += 0.05) other.push_back({t_s, std::sin(20.0 * t_s)});
  EXPECT_FALSE(LagOf(other, odometry));
}

TEST(ValueAt, IsBetweenTheTwoAboutIt) {
  const std::vector<TimedValue> series{{1.0, 10.0}, {2.0, 20.0}};
  EXPECT_DOUBLE_EQ(ValueAt(series, 1.25), 12.5);
  EXPECT_DOUBLE_EQ(ValueAt(series, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(ValueAt(series, 3.0), 20.0);
}

}  // namespace
}  // namespace trailcast::odometry
