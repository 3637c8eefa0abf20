// A follower's run ends in the middle of its route; the next one goes on from there, or says why it
// cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

using agent::ReplayState;
using agent::ReplayStep;

// The laboratory's own path, with its bends.
struct Laboratory {
  sim::Place place = test::Open("indoor");
  double length_m = sim::Length(place.path.points);
  Taught taught;

  Laboratory() {
    TrialSetup setup;
    setup.world = place.world;
    setup.path = place.path;
    setup.speed_mps = 0.4;
    auto done = TeachOnce(setup, *sim::FindCamera("webcam"), {{}}, 11, [](double) { return true; });
    if (!done) throw std::runtime_error(done.error().message);
    taught = std::move(*done);
  }
};
const Laboratory& Indoors() {
  static const Laboratory laboratory;
  return laboratory;
}

// A robot that outlives the sessions that drive it.
class Robot {
 public:
  Robot(const std::string& camera, std::uint64_t seed) {
    sim::SimulatedRobotOptions options;
    options.camera = *sim::FindCamera(camera);
    options.start = sim::StartPose(Indoors().place.path.points);
    options.start_z_max_m = Indoors().place.path.z_max_m;
    options.seed = seed;
    robot_ = *sim::SimulatedRobot::Create(Indoors().place.world, options);
  }
  // Until it is so far along the route, or the session ends. The robot stands after.
  ReplayStep Drive(agent::ReplaySession& session, double until_m = 1e9) {
    constexpr int kPatience_frames = 2400;
    ReplayStep last;
    commanded_m_ = 0.0;
    for (int frame = 0; frame < kPatience_frames; ++frame) {
      sim::Observation seen = robot_->Step(last.command);
      agent::Observation observation{seen.stamp, std::move(seen.image), seen.odometry};
      observation.told = last.command;
      auto step = session.Observe(observation);
      EXPECT_TRUE(step) << step.error().message;
      last = *step;
      commanded_m_ += std::abs(last.command.linear_mps) / 30.0;
      if (last.state == ReplayState::kLost || last.state == ReplayState::kArrived) break;
      if (last.along_m && *last.along_m >= until_m) break;
    }
    for (int frame = 0; frame < 15; ++frame) (void)robot_->Step({});
    return last;
  }
  // Returns what the last session asked for.
  [[nodiscard]] double commanded_m() const { return commanded_m_; }
  void Carry(const motion::Pose2& by) { sim::Judge(*robot_).Shove(by); }
  // Its true distance from a place on the path.
  [[nodiscard]] double DistanceTo(double along_m) {
    return (motion::Position(sim::Judge(*robot_).true_pose()) -
            sim::PointAlong(Indoors().place.path.points, along_m))
        .norm();
  }

 private:
  std::unique_ptr<sim::SimulatedRobot> robot_;
  double commanded_m_ = 0.0;
};

agent::ReplaySession Session() {
  auto session = OpenSession(Indoors().taught.routes.front(), {});
  EXPECT_TRUE(session) << session.error().message;
  return std::move(*session);
}

// Where a run that was killed has left its robot.
agent::LeftAt Killed(Robot& robot, agent::ReplaySession session, double at_m) {
  const ReplayStep last = robot.Drive(session, at_m);
  EXPECT_GE(last.along_m.value_or(0.0), at_m) << last.reason;
  return {last.along_m.value_or(0.0), last.magnification};
}

agent::ReplaySession GoingOn(const agent::LeftAt& left) {
  agent::ReplaySession session = Session();
  session.GoOnFrom(left);
  return session;
}

void ExpectItArrives(Robot& robot, agent::ReplaySession session) {
  const ReplayStep last = robot.Drive(session);
  EXPECT_EQ(last.state, ReplayState::kArrived) << last.reason;
  EXPECT_LT(robot.DistanceTo(Indoors().length_m), 0.15);
}

class RestartByCamera : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Cameras, RestartByCamera, testing::Values("webcam", "wide", "firewire"),
                         [](const auto& test) { return std::string(test.param); });

TEST_P(RestartByCamera, GoesOnFromWhereItStandsTimeAndAgain) {
  Robot robot(GetParam(), 21);
  agent::LeftAt left = Killed(robot, Session(), 1.3);
  for (const double at_m : {4.0, 7.6, 11.1, 14.2}) {
    left = Killed(robot, GoingOn(left), at_m);
    EXPECT_LT(robot.DistanceTo(at_m), 0.3) << at_m;
    EXPECT_LT(robot.commanded_m(), 4.0) << "it did not begin anew";
  }
  ExpectItArrives(robot, GoingOn(left));
}

// The note may be a second old, or the robot may be put back not quite where it was.
TEST(RestartTest, GoesOnFromAMetreFurtherAndFromBesideThePath) {
  Robot robot("webcam", 22);
  agent::LeftAt left = Killed(robot, Session(), 2.0);
  robot.Carry({0.9, 0.0, 0.0});
  left = Killed(robot, GoingOn(left), 7.0);
  robot.Carry({-0.4, 0.0, 0.0});
  left = Killed(robot, GoingOn(left), 9.0);
  robot.Carry({0.3, 0.1, 0.07});
  left = Killed(robot, GoingOn(left), 12.0);
  robot.Carry({0.0, -0.15, 0.05});
  ExpectItArrives(robot, GoingOn(left));
}

// A person who says where the robot stands knows it by eye, and nothing of its camera.
TEST(RestartTest, BeginsWhereItIsToldWithWhateverCamera) {
  for (const auto& [camera, off_m] : {std::pair("wide", -0.3), std::pair("firewire", 0.2)}) {
    SCOPED_TRACE(camera);
    Robot robot(camera, 26);
    const double stands_m = Killed(robot, Session(), 3.0).along_m;
    (void)Killed(robot, GoingOn({stands_m + off_m, std::nullopt}), 7.0);
    EXPECT_LT(robot.commanded_m(), 5.0) << "it did not begin anew";
    EXPECT_LT(robot.DistanceTo(7.0), 0.3);
  }
}

TEST(RestartTest, BeginsNowhereElseThanWhereItIsTold) {
  Robot robot("wide", 27);
  agent::ReplaySession session = GoingOn({7.0, std::nullopt});
  const ReplayStep last = robot.Drive(session);
  EXPECT_EQ(last.state, ReplayState::kLost);
  EXPECT_THAT(last.reason, testing::HasSubstr("not where it is said to stand, 7.0 m along"));
  EXPECT_EQ(robot.commanded_m(), 0.0) << "it does not drive";
}

TEST(RestartTest, BeginsAnewWhereItWasPutBackToTheStart) {
  Robot robot("webcam", 23);
  ExpectItArrives(robot, GoingOn({9.0, 1.0}));
}

TEST(RestartTest, SaysWhyItCannotGoOnWhereItWasCarriedAway) {
  for (const double carried_to_m : {4.0, 11.0}) {
    SCOPED_TRACE(carried_to_m);
    Robot robot("webcam", 24);
    const agent::LeftAt left = Killed(robot, Session(), carried_to_m);
    // It is the note that is ten metres off, and not the robot: the same to both.
    const double noted_m = carried_to_m < 7.0 ? carried_to_m + 10.0 : carried_to_m - 10.0;
    agent::ReplaySession second = GoingOn({noted_m, left.magnification});
    const ReplayStep last = robot.Drive(second);
    EXPECT_EQ(last.state, ReplayState::kLost);
    EXPECT_THAT(last.reason, testing::HasSubstr("not where it was left"));
    EXPECT_FALSE(last.along_m);
    EXPECT_EQ(robot.commanded_m(), 0.0) << "it does not drive";
  }
}

TEST(RestartTest, SaysWhyItCannotGoOnWhereItWasTurnedRound) {
  Robot robot("webcam", 25);
  const agent::LeftAt left = Killed(robot, Session(), 3.0);
  robot.Carry({0.0, 0.0, 3.0});
  agent::ReplaySession second = GoingOn(left);
  EXPECT_EQ(robot.Drive(second).state, ReplayState::kLost);
  EXPECT_EQ(robot.commanded_m(), 0.0);
}

}  // namespace
}  // namespace trailcast::trial
