#include "agent/session/src/place/place_trust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

constexpr double kPeriod_s = 0.1;
constexpr belief::RouteBelief::Place kHeld{10.0, 0.1, 0.99, 0.01, 20, true};
constexpr belief::RouteBelief::Place kNotHeld{10.0, 0.1, 0.2, 0.8, 3, false};

TEST(PlaceTrust, FollowsWhileThePlaceIsHeld) {
  PlaceTrust trust;
  EXPECT_EQ(trust.Judge(kHeld, kPeriod_s).trust, Trust::kSure);
  EXPECT_TRUE(trust.ever_sure());
}

TEST(PlaceTrust, ARobotThatHasNotFoundTheRouteSeeksAndIsThenLost) {
  PlaceTrust trust({.limit_s = 1.0});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(trust.Judge(kNotHeld, kPeriod_s).trust, Trust::kSeeking);
  const Verdict verdict = trust.Judge(kNotHeld, kPeriod_s);
  EXPECT_EQ(verdict.trust, Trust::kLost);
  EXPECT_THAT(verdict.reason, HasSubstr("the route is not recognised for 1.1 s"));
  EXPECT_THAT(verdict.reason, HasSubstr("off the route with 80 %"));
}

TEST(PlaceTrust, ALostRobotIsFoundAgain) {
  PlaceTrust trust({.limit_s = 1.0});
  EXPECT_EQ(trust.Judge(kHeld, kPeriod_s).trust, Trust::kSure);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(trust.Judge(kNotHeld, kPeriod_s).trust, Trust::kBlind);
  EXPECT_EQ(trust.Judge(kNotHeld, kPeriod_s).trust, Trust::kLost);
  EXPECT_EQ(trust.Judge(kHeld, kPeriod_s).trust, Trust::kSure);
  EXPECT_EQ(trust.Judge(kNotHeld, kPeriod_s).trust, Trust::kBlind);
}

}  // namespace
}  // namespace trailcast::agent
