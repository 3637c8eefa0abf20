#include "services/route/as_driven.h"

#include <gtest/gtest.h>

#include "services/route/usual_camera.h"

namespace trailcast::route {
namespace {

Segment Seen() {
  Segment segment;
  segment.duration_s = 4.0;
  segment.seen_way = SeenWay{1.5, {{0.1, -0.02, 0.003}}};
  return segment;
}

TEST(AsDriven, ASegmentWithoutOdometryIsDrivenAsItsPicturesTellAtTheUsualSpeed) {
  const Segment driven = AsDriven(Seen());
  ASSERT_TRUE(driven.has_odometry);
  EXPECT_DOUBLE_EQ(driven.length_m, 1.5);
  EXPECT_DOUBLE_EQ(driven.speed_mps(), kUsualSpeed_mps);
  EXPECT_EQ(driven.heading, Seen().seen_way->heading);
  EXPECT_NEAR(driven.heading_change_rad, 1.5 * (0.1 + 1.5 * (-0.02 + 1.5 * 0.003)), 1e-12);
  EXPECT_GE(driven.heading_variation_rad, driven.heading_change_rad);
}

TEST(AsDriven, WhatHasOdometryOrTellsNoWayStaysAsItIs) {
  Segment with = Seen();
  with.has_odometry = true;
  with.length_m = 2.5;
  EXPECT_EQ(AsDriven(with), with);
  Segment blind = Seen();
  blind.seen_way.reset();
  EXPECT_EQ(AsDriven(blind), blind);
}

}  // namespace
}  // namespace trailcast::route
