#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "agent/tool/trial_teach.h"
#include "services/sim/judge.h"
#include "services/sim/place.h"
#include "services/sim/random.h"

namespace trailcast::tool {
namespace {

constexpr double kTaught_m = 5.0;
constexpr double kBound_m = 3.0;
constexpr double kPatience_s = 60.0;

sim::Place Open(const std::string& name) {
  sim::PlaceOptions options;
  options.world = name;
  auto place = sim::OpenPlace(options);
  EXPECT_TRUE(place) << place.error().message;
  return *place;
}

// The beginning of a place's own path, taught there.
Taught TeachIn(const sim::Place& place, const sim::CameraModel& camera, std::uint64_t seed) {
  TrialSetup setup;
  setup.world = place.world;
  setup.path = place.path;
  setup.path.points = {place.path.points.front(), sim::PointAlong(place.path.points, kTaught_m)};
  setup.speed_mps = 0.4;
  auto taught = TeachOnce(setup, camera, {{}}, seed, [](double) { return true; });
  EXPECT_TRUE(taught) << taught.error().message;
  return *taught;
}

struct Ending {
  agent::ReplayStep last;
  double driven_m = 0.0;
};

// Follows the route at another place's start, until it ends one way or the other.
Ending FollowIn(const sim::Place& place, const sim::CameraModel& camera, const Taught& taught,
                std::uint64_t seed) {
  sim::SimulatedRobotOptions options;
  options.camera = camera;
  options.start = sim::StartPose(place.path.points);
  options.start_z_max_m = place.path.z_max_m;
  options.seed = seed;
  const auto robot = sim::SimulatedRobot::Create(place.world, options);
  EXPECT_TRUE(robot) << robot.error().message;
  auto session = OpenSession(taught.routes.front(), {});
  EXPECT_TRUE(session) << session.error().message;
  sim::Judge truth(**robot);
  Ending ending;
  Eigen::Vector2d at_m = motion::Position(truth.true_pose());
  for (double time_s = 0.0; time_s < kPatience_s;) {
    sim::Observation seen = (*robot)->Step(ending.last.command);
    time_s = Seconds(seen.stamp);
    ending.driven_m += (motion::Position(truth.true_pose()) - at_m).norm();
    at_m = motion::Position(truth.true_pose());
    auto step = session->Observe({seen.stamp, std::move(seen.image), seen.odometry});
    EXPECT_TRUE(step) << step.error().message;
    ending.last = *step;
    if (ending.last.state == agent::ReplayState::kLost) break;
    if (ending.last.state == agent::ReplayState::kArrived) break;
  }
  return ending;
}

class WrongPath : public ::testing::TestWithParam<std::pair<std::string, std::string>> {};

TEST_P(WrongPath, ARobotInAnotherWorldStopsAndSaysThatItIsLost) {
  const auto [taught_in, followed_in] = GetParam();
  const sim::CameraModel camera = *sim::FindCamera("webcam");
  const Taught taught = TeachIn(Open(taught_in), camera, 11);
  const sim::Place elsewhere = Open(followed_in);
  for (const std::uint64_t seed : {21ULL, 22ULL}) {
    const Ending ending = FollowIn(elsewhere, camera, taught, seed);
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
}  // namespace trailcast::tool
