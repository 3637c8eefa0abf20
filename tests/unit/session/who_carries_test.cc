#include <gtest/gtest.h>

#include "agent/session/src/route_follower.h"

namespace trailcast::agent {
namespace {

// The features are not seen any longer, and what is recognised shows the way on.
CarrierEvidence Unseen() {
  return {.by_features = ReplayState::kBlind,
          .trust = Trust::kBlind,
          .by_views = ReplayState::kFollowing,
          .agreed = 20};
}

TEST(WhoCarries, FeaturesDoAsLongAsTheyAreTrusted) {
  CarrierEvidence evidence = Unseen();
  evidence.by_features = ReplayState::kFollowing;
  for (const Trust trust : {Trust::kSure, Trust::kDistant}) {
    evidence.trust = trust;
    EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures) << ToString(trust);
  }
  evidence.trust = Trust::kUnsure;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews);
}

TEST(WhoCarries, ViewsDoWhereTheFeaturesAreNotSeen) {
  EXPECT_EQ(WhoCarries(Unseen()), Carrier::kViews);
  CarrierEvidence evidence = Unseen();
  for (const ReplayState state : {ReplayState::kBlind, ReplayState::kLost, ReplayState::kWaiting}) {
    evidence.by_views = state;
    EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures) << ToString(state);
  }
}

TEST(WhoCarries, ViewsOfTheEndDoNotStopARobotThatFollowsItsFeatures) {
  CarrierEvidence evidence = Unseen();
  evidence.by_views = ReplayState::kArrived;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews);
  evidence.by_features = ReplayState::kFollowing;
  evidence.trust = Trust::kUnsure;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures);
}

TEST(WhoCarries, ViewsDoNotWhereSomethingStandsBeforeTheCamera) {
  CarrierEvidence evidence = Unseen();
  evidence.trust = Trust::kCovered;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures);
}

TEST(WhoCarries, ViewsDoNotBeforeFeaturesHaveToldWhereTheRobotWasPut) {
  CarrierEvidence evidence = Unseen();
  evidence.seeks_start = true;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures);
}

TEST(WhoCarries, AHandfulThatAgreesDrivesNobody) {
  CarrierEvidence evidence = Unseen();
  evidence.agreed = 9;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews) << "a recording, which goes on anyhow";
  evidence.drives = true;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kFeatures);
  evidence.agreed = 10;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews);
}

TEST(WhoCarries, TrustedOdometryDoesWhereTheViewsAreOfItsPlace) {
  CarrierEvidence evidence = Unseen();
  evidence.steers = true;
  evidence.odometry_trust = 0.3;
  for (const double apart : {-0.5, 0.0, 0.5}) {
    evidence.apart = apart;
    EXPECT_EQ(WhoCarries(evidence), Carrier::kOdometry) << apart;
  }
  for (const double apart : {-0.6, 0.6}) {
    evidence.apart = apart;
    EXPECT_EQ(WhoCarries(evidence), Carrier::kViews) << apart;
  }
  evidence.apart = 0.0;
  evidence.odometry_trust = 0.29;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews);
}

TEST(WhoCarries, OdometryDoesNotCarryARobotThatStandsOrHasArrived) {
  CarrierEvidence evidence = Unseen();
  evidence.odometry_trust = 1.0;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews) << "it does not steer";
  evidence.steers = true;
  evidence.by_views = ReplayState::kArrived;
  EXPECT_EQ(WhoCarries(evidence), Carrier::kViews);
}

}  // namespace
}  // namespace trailcast::agent
