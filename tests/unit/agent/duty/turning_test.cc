#include "agent/duty/src/turning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

using testing::HasSubstr;

constexpr double kFrame_s = 0.05;

// Turns as it is told, one frame late, unless it is held.
class WheeledDevice : public RobotDevice {
 public:
  double heading_rad = 3.0;  // of its odometry, which wraps
  bool has_odometry = true;
  bool held = false;
  std::vector<motion::VelocityCommand> told;

  Result<std::optional<Observation>> Next() override {
    if (!held) heading_rad = WrapAngle(heading_rad + before_radps_ * kFrame_s);
    before_radps_ = told.empty() ? 0.0 : told.back().angular_radps;
    Observation observation;
    observation.stamp = FromSeconds(kFrame_s * ++frames_);
    if (has_odometry) observation.odometry = motion::Pose2{1.0, 2.0, heading_rad};
    return observation;
  }
  Result<void> Drive(const motion::VelocityCommand& command) override {
    told.push_back(command);
    return {};
  }
  std::string camera() const override { return "none"; }
  std::optional<double> drive_progress() const override { return std::nullopt; }

 private:
  double before_radps_ = 0.0;
  int frames_ = 0;
};

class TurningTest : public testing::Test {
 protected:
  // Until it is there, or has failed.
  static Result<bool> Turned(Turning& turning, double to_rad) {
    Result<bool> there = false;
    for (int i = 0; i < 2000 && there && !*there; ++i) there = turning.TurnOnTo(to_rad);
    return there;
  }

  WheeledDevice device_;
};

TEST_F(TurningTest, ItTurnsOnTheSpotAsFarAsItIsToldAndStands) {
  for (const double to_rad : {3.1, -3.1, 0.4, 6.2}) {
    device_.heading_rad = 3.0;
    Turning turning(device_, 0.0);
    const auto there = Turned(turning, to_rad);
    ASSERT_TRUE(there) << there.error().message;
    EXPECT_TRUE(*there);
    EXPECT_NEAR(WrapAngle(device_.heading_rad - 3.0 - to_rad), 0.0, 0.06) << to_rad;
    EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
  }
  EXPECT_TRUE(std::all_of(device_.told.begin(), device_.told.end(), [](const auto& command) {
    return command.linear_mps == 0.0 && std::abs(command.angular_radps) <= 0.5;
  }));
}

TEST_F(TurningTest, WhoIsInterruptedStandsAndIsTurnedBack) {
  double turned_rad = 0.0;
  {
    Turning turning(device_, 0.0);
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(turning.TurnOnTo(3.1));
    turned_rad = turning.turned_rad();
    EXPECT_GT(turned_rad, 0.4);
    EXPECT_NE(device_.told.back(), motion::VelocityCommand{});
  }
  EXPECT_EQ(device_.told.back(), motion::VelocityCommand{});
  Turning turning(device_, turned_rad);
  ASSERT_TRUE(Turned(turning, 0.0));
  EXPECT_NEAR(WrapAngle(device_.heading_rad - 3.0), 0.0, 0.1);
}

TEST_F(TurningTest, WhoCannotTurnSaysWhy) {
  device_.held = true;
  Turning held(device_, 0.0);
  const auto stuck = Turned(held, 3.1);
  ASSERT_FALSE(stuck);
  EXPECT_THAT(stuck.error().message, HasSubstr("by 178 degrees more, and has not moved for 30 s"));
  device_.has_odometry = false;
  Turning blind(device_, 0.0);
  const auto none = Turned(blind, 3.1);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("no odometry"));
}

}  // namespace
}  // namespace trailcast::agent
