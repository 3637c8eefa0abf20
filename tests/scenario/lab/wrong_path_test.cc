#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

constexpr double kTaught_m = 5.0;
constexpr double kBound_m = 3.0;

class WrongPath : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(WrongPath, ARobotInAnotherWorldStopsAndSaysThatItIsLost) {
  const auto [taught_in, followed_in] = GetParam();
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = test::TeachIn(test::Open(taught_in), kTaught_m, camera, 11);
  const sim::Place elsewhere = test::Open(followed_in);
  for (const std::uint64_t seed : {21ULL, 22ULL}) {
    const test::Ending ending = test::FollowIn(elsewhere, camera, taught, seed);
    EXPECT_EQ(ending.last.state, agent::ReplayState::kLost) << agent::ToString(ending.last.state);
    EXPECT_LT(ending.driven_m, kBound_m);
    EXPECT_EQ(ending.last.command, motion::VelocityCommand{});
    EXPECT_FALSE(ending.last.reason.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, WrongPath,
                         ::testing::Values(std::pair("indoor", "desks"),
                                           std::pair("turns", "indoor"),
                                           std::pair("paved", "ramp")));

}  // namespace
}  // namespace trailcast::trial
