#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/places/place.h"
#include "services/lab/trial/trial_teach.h"

namespace trailcast::trial::test {

inline sim::Place Open(const std::string& name) {
  sim::PlaceOptions options;
  options.world = name;
  auto place = sim::OpenPlace(options);
  EXPECT_TRUE(place) << place.error().message;
  return *place;
}

// This is the beginning of a place's own path, taught there.
inline Taught TeachIn(const sim::Place& place, double length_m, const sim::CameraModel& camera,
                      std::uint64_t seed) {
  TrialSetup setup;
  setup.world = place.world;
  setup.path = place.path;
  setup.path.points = {place.path.points.front(), sim::PointAlong(place.path.points, length_m)};
  setup.speed_mps = 0.4;
  auto taught = TeachOnce(setup, camera, {{}}, seed, [](double) { return true; });
  EXPECT_TRUE(taught) << taught.error().message;
  return *taught;
}

struct Ending {
  agent::ReplayStep last;
  motion::Pose2 pose;  // the truth
  double driven_m = 0.0;
};

// This watches frame by frame, and may push the robot.
using Bystander = std::function<void(sim::Judge& truth, const agent::ReplayStep& step)>;

// This is where a follower starts, if not at the start of the path, and in which gear.
struct Outset {
  std::optional<motion::Pose2> start{};
  bool backwards = false;
};

// Follows the route from the start of a place's path until it ends one way or the other.
inline Ending FollowIn(
    const sim::Place& place, const sim::CameraModel& camera, const Taught& taught,
    std::uint64_t seed, const Bystander& bystander = [](sim::Judge&, const agent::ReplayStep&) {},
    const agent::ReplayMethodOptions& how = {}, const Outset& outset = {}) {
  constexpr double kPatience_s = 90.0;
  sim::SimulatedRobotOptions options;
  options.camera = camera;
  options.start = outset.start.value_or(sim::StartPose(place.path.points));
  options.start_z_max_m = place.path.z_max_m;
  options.seed = seed;
  const auto robot = sim::SimulatedRobot::Create(place.world, options);
  EXPECT_TRUE(robot) << robot.error().message;
  auto session = OpenSession(taught.routes.front(), how, outset.backwards);
  EXPECT_TRUE(session) << session.error().message;
  sim::Judge truth(**robot);
  Ending ending;
  Eigen::Vector2d at_m = motion::Position(truth.true_pose());
  for (double time_s = 0.0; time_s < kPatience_s;) {
    sim::Observation seen = (*robot)->Step(ending.last.command);
    time_s = Seconds(seen.stamp);
    ending.driven_m += (motion::Position(truth.true_pose()) - at_m).norm();
    auto step = session->Observe({seen.stamp, std::move(seen.image), seen.odometry});
    EXPECT_TRUE(step) << step.error().message;
    ending.last = *step;
    if (ending.last.state == agent::ReplayState::kLost) break;
    if (ending.last.state == agent::ReplayState::kArrived) break;
    bystander(truth, ending.last);
    at_m = motion::Position(truth.true_pose());
  }
  ending.pose = truth.true_pose();
  return ending;
}

}  // namespace trailcast::trial::test
