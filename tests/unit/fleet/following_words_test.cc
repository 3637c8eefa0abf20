#include "services/fleet/following_words.h"

#include <gtest/gtest.h>

namespace trailcast::fleet {
namespace {

using exchange::CarriedBy;
using exchange::OdometryTrust;

std::string Text(CarriedBy carried_by, std::optional<OdometryTrust> odometry) {
  exchange::AgentStatus status;
  status.following = exchange::Following{carried_by, odometry};
  return FollowingText(status);
}

std::string Text(OdometryTrust odometry) { return Text(CarriedBy::kFeatures, odometry); }

TEST(FollowingWords, AreNoneOfARobotThatDoesNotFollow) {
  EXPECT_EQ(FollowingText(exchange::AgentStatus{}), "");
}

TEST(FollowingWords, SayThatARobotHasNoOdometry) {
  EXPECT_EQ(Text(CarriedBy::kViews, std::nullopt), "Follows by its camera alone");
}

TEST(FollowingWords, TrustOdometryThatAgreesWithTheRoute) {
  EXPECT_EQ(Text({100, 1.0}), "Odometry: trusted");
  EXPECT_EQ(Text({100, 0.97}), "Odometry: trusted");
  EXPECT_EQ(Text({100, 0.0}), "Odometry: trusted") << "its scale is not known";
}

TEST(FollowingWords, SayHowManyTimesTooMuchOrTooLittleItCounts) {
  EXPECT_EQ(Text({100, 1.0 / 1.38}),
            "Odometry: counts 1.38 times too much for this route, corrected");
  EXPECT_EQ(Text({80, 1.25}), "Odometry: counts 1.25 times too little for this route, corrected");
}

TEST(FollowingWords, SayWhatCarriesARobotWhoseOdometryIsNotBelieved) {
  EXPECT_EQ(Text(CarriedBy::kFeatures, OdometryTrust{3, 1.0}),
            "Odometry: not believed; the pictures carry the robot");
  EXPECT_EQ(Text(CarriedBy::kViews, OdometryTrust{19, 2.0}),
            "Odometry: not believed; the pictures carry the robot");
  EXPECT_EQ(Text(CarriedBy::kMotion, OdometryTrust{0, 1.0}),
            "Odometry: not believed, and the pictures do not show the route");
  EXPECT_EQ(Text(CarriedBy::kNothing, OdometryTrust{0, 1.0}), "Odometry: not believed");
  EXPECT_EQ(Text({20, 1.38}), "Odometry: in doubt") << "of which no scale is known";
}

TEST(FollowingWords, SayThatNothingElseCarriesTheRobot) {
  EXPECT_EQ(Text(CarriedBy::kMotion, OdometryTrust{100, 1.0}),
            "Odometry: trusted; it alone carries the robot");
}

}  // namespace
}  // namespace trailcast::fleet
