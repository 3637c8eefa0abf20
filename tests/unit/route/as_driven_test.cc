#include "services/route/as_driven.h"

#include <gtest/gtest.h>

#include "services/route/usual_camera.h"

namespace trailcast::route {
namespace {

Segment Seen() {
  Segment segment;
  segment.duration_s = 4.0;
  segment.seen_heading = HeadingPolynomial{{0.1, -0.02, 0.003}};  // of seconds
  return segment;
}

double Cubic(const HeadingPolynomial& heading, double x) {
  return x * (heading.c[0] + x * (heading.c[1] + x * heading.c[2]));
}

TEST(AsDriven, ASegmentWithoutOdometryTurnsWhereItsPictureDid) {
  const Segment driven = AsDriven(Seen());
  ASSERT_TRUE(driven.has_odometry);
  EXPECT_DOUBLE_EQ(driven.length_m, 4.0 * kUsualSpeed_mps);
  EXPECT_DOUBLE_EQ(driven.speed_mps(), kUsualSpeed_mps);
  for (const double t_s : {0.0, 1.0, 2.5, 4.0}) {
    EXPECT_NEAR(Cubic(driven.heading, kUsualSpeed_mps * t_s), Cubic(*Seen().seen_heading, t_s),
                1e-12);
  }
  EXPECT_NEAR(driven.heading_change_rad, Cubic(*Seen().seen_heading, 4.0), 1e-12);
  EXPECT_GE(driven.heading_variation_rad, driven.heading_change_rad);
}

TEST(AsDriven, WhatHasOdometryOrTellsNoTurnStaysAsItIs) {
  Segment with = Seen();
  with.has_odometry = true;
  with.length_m = 1.5;
  EXPECT_EQ(AsDriven(with), with);
  Segment blind = Seen();
  blind.seen_heading.reset();
  EXPECT_EQ(AsDriven(blind), blind);
}

}  // namespace
}  // namespace trailcast::route
