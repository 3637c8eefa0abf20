// A teaching is cut off in the middle, the robot is driven over the last metres once more, and the
// teaching goes on: what a follower makes of the join.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>

#include "agent/session/end_finder.h"
#include "agent/session/teach_session.h"
#include "services/route/digest.h"
#include "services/sim/core/path_follow_driver.h"
#include "tests/scenario/taught_run.h"

namespace trailcast::trial {
namespace {

using agent::ReplayState;

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
  // Carried by hand, and driven on from there, the rest of the path.
  void Carry(const motion::Pose2& by) {
    constexpr double kEvery_m = 0.5;
    sim::Judge(*robot_).Shove(by);
    sim::Polyline rest{motion::Position(pose())};
    for (double at_m = along_m() + kEvery_m; at_m < sim::Length(points_); at_m += kEvery_m) {
      rest.push_back(sim::PointAlong(points_, at_m));
    }
    rest.push_back(points_.back());
    driver_ = sim::PathFollowDriver(rest);
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

void Append(TaughtRoute& taught, const std::optional<route::Segment>& segment) {
  if (!segment) return;
  ASSERT_EQ(segment->index.value(), taught.info.segment_count);
  taught.pieces.push_back(route::MakePiece(taught.info.key, *segment));
  taught.info.segment_count += 1;
  taught.info.length_m += segment->length_m;
}

class ContinuedTeaching : public testing::Test {
 protected:
  // Cut off at `cut_off_m`, when the segment under way is lost; then carried and driven on.
  void TeachInTwo(double cut_off_m, const motion::Pose2& carried) {
    taught_.info.key = {RouteId(std::string(32, '0')), TeachingId(1)};
    taught_.info.camera = "webcam";
    taught_.info.state = route::RouteState::kComplete;
    DrivenRobot robot(place_);
    agent::TeachSession before;
    motion::Pose2 end;
    while (robot.along_m() < cut_off_m) {
      const agent::Observation seen = robot.Step();
      taught_.info.image_width_px = seen.image.width;
      taught_.info.image_height_px = seen.image.height;
      const auto step = before.Observe(seen);
      ASSERT_TRUE(step) << step.error().message;
      if (step->finished) end = robot.pose();
      Append(taught_, step->finished);
    }
    ASSERT_GE(taught_.info.segment_count, 2U);
    robot.Carry(carried);
    agent::EndFinder finder(*route::Open(taught_.pieces.back()), taught_.info.image_width_px);
    agent::Observation seen = robot.Step();
    while (!finder.Look(seen.image)) {
      ASSERT_FALSE(robot.arrived()) << "not found: " << finder.MostSeen();
      seen = robot.Step();
    }
    off_m_ = (motion::Position(robot.pose()) - motion::Position(end)).norm();
    agent::TeachOptions options;
    options.recorder.first_index = SegmentIndex(taught_.info.segment_count);
    agent::TeachSession after(options);
    for (; !robot.arrived(); seen = robot.Step()) {
      const auto step = after.Observe(seen);
      ASSERT_TRUE(step) << step.error().message;
      Append(taught_, step->finished);
    }
    Append(taught_, after.Finish());
  }
  void ExpectFollowed() {
    const double length_m = sim::Length(place_.path.points);
    EXPECT_NEAR(taught_.info.length_m, length_m, 0.5) << "none of it twice, and none left out";
    for (const char* camera : {"webcam", "wide"}) {
      SCOPED_TRACE(camera);
      Taught taught;
      taught.routes.push_back(taught_);
      double worst_m = 0.0;
      const test::Ending ending = test::FollowIn(
          place_, *sim::FindCamera(camera), taught, 21,
          [&](sim::Judge& truth, const agent::ReplayStep&) {
            const Eigen::Vector2d at_m = motion::Position(truth.true_pose());
            const double nearest_m = sim::Nearest(place_.path.points, at_m).along_m;
            worst_m =
                std::max(worst_m, (at_m - sim::PointAlong(place_.path.points, nearest_m)).norm());
          });
      EXPECT_EQ(ending.last.state, ReplayState::kArrived) << ending.last.reason;
      EXPECT_LT((motion::Position(ending.pose) - place_.path.points.back()).norm(), 0.25);
      EXPECT_LT(worst_m, 0.5);
    }
  }

  sim::Place place_ = test::Open("indoor");
  TaughtRoute taught_;
  double off_m_ = 0.0;  // of where it went on from where it had ended
};

TEST_F(ContinuedTeaching, AFollowerDoesNotNoticeWhereItWasCutOff) {
  TeachInTwo(6.0, {-3.0, 0.0, 0.0});
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(off_m_, 0.15);
  ExpectFollowed();
}

// By hand a robot is not put back on the path, nor headed along it, to the centimetre.
TEST_F(ContinuedTeaching, AFollowerMakesUpForARobotThatWasPutBackBesideThePath) {
  TeachInTwo(10.0, {-2.6, 0.12, 0.06});
  ASSERT_FALSE(HasFatalFailure());
  EXPECT_LT(off_m_, 0.3);
  ExpectFollowed();
}

// Beyond the end, or on another part of the path, nothing is taken for it.
TEST_F(ContinuedTeaching, ARobotThatStandsElsewhereGoesOnNowhere) {
  DrivenRobot robot(place_);
  agent::TeachSession session;
  std::optional<route::Segment> last;
  while (robot.along_m() < 6.0) {
    auto step = session.Observe(robot.Step());
    ASSERT_TRUE(step) << step.error().message;
    if (step->finished) last = std::move(step->finished);
  }
  ASSERT_TRUE(last);
  const agent::Observation seen = robot.Step();
  agent::EndFinder finder(*last, seen.image.width);
  while (robot.along_m() < 7.0) (void)robot.Step();
  while (!robot.arrived()) EXPECT_FALSE(finder.Look(robot.Step().image)) << robot.along_m();
}

}  // namespace
}  // namespace trailcast::trial
