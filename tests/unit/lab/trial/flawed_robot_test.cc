#include "services/lab/trial/src/flawed_robot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/lab/sim/core/judge.h"
#include "tests/unit/lab/sim/test_worlds.h"

namespace trailcast::trial {
namespace {

using testing::Contains;
using testing::HasSubstr;
using Kind = agent::RobotFault::Kind;

const motion::VelocityCommand kAhead{0.5, 0.0};

// A plain floor, and a robot upon it that does as it is told.
class FlawedRobotTest : public testing::Test {
 protected:
  void Open(const agent::RobotTiming& timing, const std::vector<agent::RobotFault>& faults) {
    world_ = sim::test::SmallWorld().Build();
    sim::SimulatedRobotOptions options;
    options.camera.width = 80;  // nobody looks at its pictures
    options.camera.height = 60;
    options.disturbances = sim::Disturbances::None();
    body_ = sim::SimulatedRobot::Create(world_, options).value();
    RobotFlaws flaws;
    flaws.timing = timing;
    flaws.faults = faults;
    robot_.emplace(*body_, flaws, 1);
  }
  std::optional<agent::Observation> Next(const motion::VelocityCommand& command) {
    return robot_->Next(command, [this](SensorTime now) {
      now_ = now;
      ++steps_;
    });
  }
  [[nodiscard]] double TrueX() { return sim::Judge(*body_).true_pose().x_m; }

  std::shared_ptr<const sim::World> world_;
  std::unique_ptr<sim::SimulatedRobot> body_;
  std::optional<FlawedRobot> robot_;
  SensorTime now_{};
  int steps_ = 0;
};

TEST_F(FlawedRobotTest, WithoutFlawsSeesWhatTheBodySees) {
  Open({}, {});
  for (int i = 0; i < 30; ++i) {
    const auto seen = Next(kAhead);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->stamp, now_);
    EXPECT_NEAR(seen->odometry->x_m, TrueX(), 1e-9);
  }
  EXPECT_EQ(steps_, 30);
  EXPECT_GT(TrueX(), 0.3);
}

TEST_F(FlawedRobotTest, ALatePictureHasTheOdometryOfItsOwnMoment) {
  agent::RobotTiming timing;
  timing.picture_delay_s = 0.2;
  Open(timing, {});
  for (int i = 0; i < 60; ++i) (void)Next(kAhead);
  const auto seen = Next(kAhead);
  ASSERT_TRUE(seen);
  EXPECT_NEAR(Seconds(now_ - seen->stamp), 0.2, 0.034);
  EXPECT_NEAR(TrueX() - seen->odometry->x_m, 0.5 * 0.2, 0.02);
}

TEST_F(FlawedRobotTest, StampsOfAnotherClockAreNoticedAndToldOf) {
  agent::RobotTiming timing;
  timing.stamps_late_s = 1.5;
  Open(timing, {});
  std::vector<std::string> news;
  std::optional<agent::Observation> seen;
  for (int i = 0; i < 300; ++i) {
    seen = Next(kAhead);
    ASSERT_TRUE(seen);
    for (std::string& line : robot_->TakeNews()) news.push_back(std::move(line));
  }
  EXPECT_THAT(news, Contains(HasSubstr("different clocks")));
  EXPECT_NEAR(seen->odometry->x_m, TrueX(), 0.05);
}

TEST_F(FlawedRobotTest, OdometryThatRestartsGoesOnFromWhereItWas) {
  Open({}, {{Kind::kOdometryRestarts, {1.0}}});
  std::vector<std::string> news;
  double unknown_m = 0.0;
  std::optional<agent::Observation> seen;
  for (int i = 0; i < 90; ++i) {
    seen = Next({1.0, 0.0});
    ASSERT_TRUE(seen);
    unknown_m += seen->unknown.distance_m;
    for (std::string& line : robot_->TakeNews()) news.push_back(std::move(line));
  }
  EXPECT_THAT(news, Contains(HasSubstr("odometry jumped by")));
  EXPECT_GT(unknown_m, 0.0);
  EXPECT_NEAR(seen->odometry->x_m, TrueX(), 0.1);
}

TEST_F(FlawedRobotTest, ACameraThatIsSilentForLongEndsIt) {
  Open({}, {{Kind::kCameraStops, {0.5}}});
  std::optional<agent::Observation> seen;
  for (int i = 0; i < 100 && (seen = Next(kAhead)); ++i) {
  }
  EXPECT_FALSE(seen);
  EXPECT_LT(TrueX(), 1.0) << "no command came for long: the base stands";
}

}  // namespace
}  // namespace trailcast::trial
