#include "agent/session/src/frame_pace.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

FramePace At(double rate_hz) {
  FramePace pace;
  for (int i = 0; i < 20; ++i) pace.Note(1.0 / rate_hz);
  return pace;
}

TEST(FramePace, LeavesARobotThatSeesOftenAsItIs) {
  const motion::VelocityCommand bend{0.5, 0.8};
  EXPECT_EQ(FramePace().Within(bend), bend) << "no picture yet";
  EXPECT_EQ(At(30.0).Within(bend), bend);
  EXPECT_EQ(At(10.0).Within(bend), bend);
}

TEST(FramePace, SlowsDownOneThatSeesSeldomAndKeepsItsCurve) {
  const motion::VelocityCommand slower = At(4.0).Within({0.4, 0.8});
  EXPECT_NEAR(slower.angular_radps * 0.25, FramePaceOptions{}.furthest_turn_rad, 1e-9);
  EXPECT_NEAR(slower.angular_radps / slower.linear_mps, 2.0, 1e-9);
  const motion::VelocityCommand back = At(4.0).Within({-1.0, 0.0});
  EXPECT_NEAR(back.linear_mps * 0.25, -FramePaceOptions{}.furthest_m, 1e-9);
}

TEST(FramePace, GoesByTheLastPictures) {
  FramePace pace = At(4.0);
  for (int i = 0; i < 8; ++i) pace.Note(1.0 / 30.0);
  EXPECT_EQ(pace.Within({0.4, 0.8}), (motion::VelocityCommand{0.4, 0.8}));
}

}  // namespace
}  // namespace trailcast::agent
