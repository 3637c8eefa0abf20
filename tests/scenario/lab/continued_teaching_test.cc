// A teaching is cut off in the middle: where the robot stands elsewhere, it does not go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "agent/session/end_finder.h"
#include "agent/session/teach_session.h"
#include "services/lab/sim/core/path_follow_driver.h"
#include "tests/scenario/lab/taught_run.h"

namespace trailcast::trial {
namespace {

// A scout's robot in the laboratory, which outlives the teachings; somebody drives it.
class DrivenRobot {
 public:
  explicit DrivenRobot(const sim::Place& place) : points_(place.path.points), driver_(points_) {
    sim::SimulatedRobotOptions options;
    options.camera = *sim::FindCamera("webcam");
    options.start = sim::StartPose(points_);
    options.start_z_max_m = place.path.z_max_m;
    options.disturbances = sim::Disturbances::ForScout();
    options.seed = 11;
    robot_ = *sim::SimulatedRobot::Create(place.world, options);
  }

  agent::Observation Step() {
    sim::Observation seen = robot_->Step(driver_.Command(pose()));
    return {seen.stamp, std::move(seen.image), seen.odometry};
  }
  [[nodiscard]] motion::Pose2 pose() const { return sim::Judge(*robot_).true_pose(); }
  [[nodiscard]] double along_m() const {
    return sim::Nearest(points_, motion::Position(pose())).along_m;
  }
  [[nodiscard]] bool arrived() const { return driver_.arrived(); }

 private:
  sim::Polyline points_;
  sim::PathFollowDriver driver_;
  std::unique_ptr<sim::SimulatedRobot> robot_;
};

// Beyond the end, or on another part of the path, nothing is taken for it.
TEST(ContinuedTeaching, ARobotThatStandsElsewhereGoesOnNowhere) {
  DrivenRobot robot(test::Open("indoor"));
  agent::TeachSession session;
  std::optional<route::Segment> last;
  int steps = 0;
  const auto drives_to = [&](double along_m) {
    EXPECT_LT(++steps, 10'000) << "it stands at " << robot.along_m();
    return robot.along_m() < along_m && steps < 10'000;
  };
  while (drives_to(6.0)) {
    auto step = session.Observe(robot.Step());
    ASSERT_TRUE(step) << step.error().message;
    if (step->finished) last = std::move(step->finished);
  }
  ASSERT_TRUE(last);
  const agent::Observation seen = robot.Step();
  agent::EndFinder finder(*last, seen.image.width);
  while (drives_to(7.0)) (void)robot.Step();
  while (!robot.arrived() && drives_to(1000.0))
    EXPECT_FALSE(finder.Look(robot.Step().image)) << robot.along_m();
}

}  // namespace
}  // namespace trailcast::trial
