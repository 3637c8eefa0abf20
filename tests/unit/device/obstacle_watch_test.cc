#include "agent/device/obstacle_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr milliseconds kScan{100};
const motion::VelocityCommand kAhead{0.4, 0.0};
const motion::VelocityCommand kStand{};

// Half a metre wide, and so a quarter to its front; looks all round, a degree a range.
class ObstacleWatchTest : public testing::Test {
 protected:
  // Next scan, with something there that fills two ranges, and nothing else.
  void See(std::optional<Eigen::Vector2d> at) {
    now_ += kScan;
    constexpr double kDegree = std::numbers::pi / 180.0;
    motion::Scan scan{-std::numbers::pi, kDegree, 0.1, 10.0, {}};
    scan.ranges_m.assign(361, std::numeric_limits<float>::infinity());
    if (at) {
      const auto index = std::lround((std::atan2(at->y(), at->x()) + std::numbers::pi) / kDegree);
      scan.ranges_m[static_cast<std::size_t>(index)] = static_cast<float>(at->norm());
      // A little further, so that it is not this that is met first.
      scan.ranges_m[static_cast<std::size_t>(index + 1)] = static_cast<float>(at->norm() + 0.02);
    }
    watch_.See(now_, scan);
  }
  void SeeFor(milliseconds duration, std::optional<Eigen::Vector2d> at) {
    for (milliseconds passed{0}; passed < duration; passed += kScan) See(at);
  }

  ObstacleWatch watch_{ObstacleOptions{}, true};
  ObstacleWatch::Time now_{};
};

TEST_F(ObstacleWatchTest, LeavesWhatIsFreeAsItIs) {
  EXPECT_FALSE(watch_.has_seen_all());
  See(std::nullopt);
  EXPECT_TRUE(watch_.has_seen_all());
  EXPECT_EQ(watch_.Want(kAhead), kAhead);
  See(Eigen::Vector2d(3.0, 0.0));
  EXPECT_EQ(watch_.Want(kAhead), kAhead);
  See(Eigen::Vector2d(0.5, 0.4));
  EXPECT_EQ(watch_.Want(kAhead), kAhead) << "beside its way";
  EXPECT_FALSE(watch_.waits());
}

TEST_F(ObstacleWatchTest, SlowsDownInTheSameBend) {
  const motion::VelocityCommand bend{0.4, 0.1};
  See(Eigen::Vector2d(0.7, 0.0));
  const auto slow = watch_.Want(bend);
  EXPECT_GT(slow.linear_mps, 0.05);
  EXPECT_LT(slow.linear_mps, 0.35);
  EXPECT_NEAR(slow.angular_radps / slow.linear_mps, 0.25, 1e-9);
  EXPECT_FALSE(watch_.waits());
}

// By a base that brakes as gently as it is taken to, and hears of each scan a scan late.
TEST_F(ObstacleWatchTest, StandsWithTheGapHoweverFastItCame) {
  for (const double speed_mps : {0.1, 0.4, 1.0}) {
    ObstacleWatch watch{ObstacleOptions{}, true};
    double place_m = 0.0;  // of its front
    double mps = speed_mps;
    motion::VelocityCommand told{speed_mps, 0.0};
    constexpr double kAt_m = 4.0;
    for (int i = 0; i < 1000 && !(watch.waits() && mps == 0.0); ++i) {
      now_ += kScan;
      watch.See(now_, {0.0, 0.1, 0.1, 10.0, {static_cast<float>(kAt_m - place_m + 0.25)}});
      mps = std::max(told.linear_mps, mps - 0.5 * Seconds(kScan));
      place_m += mps * Seconds(kScan);
      told = watch.Want({speed_mps, 0.0});
    }
    EXPECT_TRUE(watch.waits());
    EXPECT_GT(kAt_m - place_m, 0.25) << speed_mps;
    EXPECT_LT(kAt_m - place_m, 0.4) << speed_mps;
  }
}

TEST_F(ObstacleWatchTest, SaysWhatItWaitsForUntilItGoesOn) {
  See(Eigen::Vector2d(0.5, 0.1));
  std::ignore = watch_.Want(kAhead);
  ASSERT_TRUE(watch_.waits());
  EXPECT_EQ(*watch_.waits(),
            "something stands 0.3 m ahead, 0.1 m to the left, in the way: the robot waits");
  See(Eigen::Vector2d(0.4, -0.1));
  EXPECT_THAT(*watch_.waits(), HasSubstr("0.3 m ahead, 0.1 m to the left"));
}

TEST_F(ObstacleWatchTest, GoesOnOnceItIsClearForHalfASecond) {
  See(Eigen::Vector2d(0.5, 0.0));
  std::ignore = watch_.Want(kAhead);
  SeeFor(milliseconds(5000), Eigen::Vector2d(0.5, 0.0));
  EXPECT_TRUE(watch_.waits());
  SeeFor(milliseconds(500), std::nullopt);
  EXPECT_TRUE(watch_.waits()) << "the first of these was at 0.1 s";
  See(Eigen::Vector2d(0.5, 0.0));
  SeeFor(milliseconds(500), std::nullopt);
  EXPECT_TRUE(watch_.waits()) << "anew";
  See(std::nullopt);
  EXPECT_FALSE(watch_.waits());
}

TEST_F(ObstacleWatchTest, WhoShiftsFromOneFootToTheOtherIsStillThere) {
  See(Eigen::Vector2d(0.5, 0.0));
  std::ignore = watch_.Want(kAhead);
  SeeFor(milliseconds(2000), Eigen::Vector2d(0.62, 0.0));
  EXPECT_TRUE(watch_.waits());
  SeeFor(milliseconds(700), Eigen::Vector2d(0.75, 0.0));
  EXPECT_FALSE(watch_.waits());
}

TEST_F(ObstacleWatchTest, WaitsForWhatIsBesideItOnlyWhereItWouldTurnIntoThat) {
  See(Eigen::Vector2d(0.0, 0.35));
  std::ignore = watch_.Want(kAhead);
  EXPECT_FALSE(watch_.waits());
  std::ignore = watch_.Want({0.0, 0.5});
  ASSERT_TRUE(watch_.waits());
  EXPECT_THAT(*watch_.waits(), HasSubstr("0.0 m ahead, 0.3 m to the left"));
}

TEST_F(ObstacleWatchTest, AskedToGoAnotherWayItGoesAtOnceWhereThatIsFree) {
  const motion::VelocityCommand aside{0.0, 0.5};
  const motion::VelocityCommand back{-0.2, 0.0};
  for (const motion::VelocityCommand& away : {aside, back}) {
    See(Eigen::Vector2d(0.5, 0.0));
    EXPECT_EQ(watch_.Want(kAhead), kStand);
    EXPECT_EQ(watch_.Want(away), away);
    EXPECT_FALSE(watch_.waits());
    EXPECT_EQ(watch_.Want(kAhead), kStand) << "it is still there";
    SeeFor(milliseconds(1500), std::nullopt);
    EXPECT_EQ(watch_.Want(kAhead), kAhead);
  }
  See(Eigen::Vector2d(0.5, 0.0));
  EXPECT_EQ(watch_.Want(kAhead), kStand);
  EXPECT_EQ(watch_.Want({0.4, 0.02}), kStand) << "no other way";
  EXPECT_EQ(watch_.Want(kStand), kStand);
  EXPECT_TRUE(watch_.waits()) << "until its next look";
}

TEST_F(ObstacleWatchTest, WhoWantsToStandWaitsForNothing) {
  See(Eigen::Vector2d(0.3, 0.0));
  std::ignore = watch_.Want(kStand);
  EXPECT_FALSE(watch_.waits());
}

TEST_F(ObstacleWatchTest, AScannerAtTheFrontSaysHowFarTheRobotReaches) {
  ObstacleOptions options;
  options.scan_ahead_m = 0.6;
  ObstacleWatch watch(options, true);
  watch.See(now_, {0.0, 0.1, 0.1, 10.0, {0.5F}});
  std::ignore = watch.Want({0.1, 0.0});
  EXPECT_FALSE(watch.waits());
  watch.See(now_, {0.0, 0.1, 0.1, 10.0, {0.31F}});
  std::ignore = watch.Want({0.1, 0.0});
  EXPECT_TRUE(watch.waits());
}

TEST_F(ObstacleWatchTest, AFalsePointDoesNotStopItAndAThinPoleDoes) {
  const auto see = [&](float range_m) {
    constexpr float kFar = 5.0F;
    now_ += kScan;
    watch_.See(now_, {-0.02, 0.01, 0.1, 10.0, {kFar, kFar, range_m, kFar, kFar}});
    return watch_.Want(kAhead);
  };
  see(5.0F);
  EXPECT_EQ(see(0.5F), kAhead);
  EXPECT_EQ(see(5.0F), kAhead);
  EXPECT_FALSE(watch_.waits());
  see(0.6F);
  EXPECT_LT(see(0.55F).linear_mps, 0.2);
  see(0.53F);
  EXPECT_TRUE(watch_.waits());
}

// A sonar with a cone of 0.5 rad.
motion::ConeRange Sonar(float range_m) { return {0.5, 0.02, 4.0, range_m}; }

TEST_F(ObstacleWatchTest, StandsBeforeWhatARangeSensorSeesAndGoesOn) {
  ObstacleOptions options;
  options.range_mounts = {std::nullopt};
  ObstacleWatch watch(options, false);
  EXPECT_FALSE(watch.has_seen_all());
  EXPECT_EQ(watch.silent_range(), 0U);
  watch.See(now_, 0, Sonar(std::numeric_limits<float>::infinity()));
  EXPECT_TRUE(watch.has_seen_all());
  EXPECT_EQ(watch.Want(kAhead), kAhead);
  watch.See(now_, 0, Sonar(0.5F));  // from the front
  EXPECT_LT(watch.Want(kAhead).linear_mps, 0.4);
  EXPECT_FALSE(watch.waits());
  watch.See(now_, 0, Sonar(0.3F));
  EXPECT_EQ(watch.Want(kAhead), kStand);
  ASSERT_TRUE(watch.waits());
  EXPECT_THAT(*watch.waits(), HasSubstr("something stands 0.3 m ahead"));
  watch.See(now_ + milliseconds(100), 0, Sonar(4.0F));
  watch.See(now_ + milliseconds(700), 0, Sonar(4.0F));
  EXPECT_FALSE(watch.waits());
}

TEST_F(ObstacleWatchTest, OneThatLooksAsideStopsWhoTurnsThere) {
  ObstacleOptions options;
  options.range_mounts = {motion::Pose2{0.0, 0.2, std::numbers::pi / 2.0}};
  ObstacleWatch watch(options, false);
  watch.See(now_, 0, Sonar(0.15F));
  std::ignore = watch.Want(kAhead);
  EXPECT_FALSE(watch.waits());
  std::ignore = watch.Want({0.0, 0.5});
  EXPECT_TRUE(watch.waits());
}

TEST_F(ObstacleWatchTest, EachOfItsSensorsCounts) {
  ObstacleOptions options;
  options.range_mounts = {std::nullopt, std::nullopt};
  ObstacleWatch watch(options, true);
  watch.See(now_, 0, Sonar(0.3F));
  watch.See(now_, {0.0, 0.1, 0.1, 10.0, {9.0F}});
  EXPECT_EQ(watch.silent_range(), 1U);
  watch.See(now_, 1, Sonar(3.0F));
  EXPECT_TRUE(watch.has_seen_all());
  std::ignore = watch.Want(kAhead);
  EXPECT_TRUE(watch.waits()) << "by the first of its ranges";
}

// Returns a scan of the quarter turn ahead only.
motion::Scan LookAhead() {
  motion::Scan scan{-0.785, 0.01, 0.1, 10.0, {}};
  scan.ranges_m.assign(158, std::numeric_limits<float>::infinity());
  return scan;
}

TEST_F(ObstacleWatchTest, BackwardsWhereNothingLooksItGoesSlowlyAndKnowsIt) {
  const motion::VelocityCommand back{-0.4, 0.2};
  See(std::nullopt);
  EXPECT_EQ(watch_.Want(back), back) << "looks all round";
  EXPECT_FALSE(watch_.backs_unseen());
  See(Eigen::Vector2d(-0.6, 0.05));
  EXPECT_EQ(watch_.Want({-0.4, 0.0}), kStand);
  ObstacleWatch ahead{ObstacleOptions{}, true};
  ahead.See(now_, LookAhead());
  EXPECT_EQ(ahead.Want(kAhead), kAhead);
  EXPECT_FALSE(ahead.backs_unseen());
  const motion::VelocityCommand slow = ahead.Want(back);
  EXPECT_TRUE(ahead.backs_unseen());
  EXPECT_NEAR(slow.linear_mps, -ObstacleWatch::kUnseen_mps, 1e-9);
  EXPECT_NEAR(slow.angular_radps / slow.linear_mps, back.angular_radps / back.linear_mps, 1e-9);
  ObstacleOptions options;
  options.range_mounts = {motion::Pose2{-0.2, 0.0, std::numbers::pi}};
  ObstacleWatch behind{options, true};
  behind.See(now_, LookAhead());
  EXPECT_EQ(behind.Want(back), back);
}

}  // namespace
}  // namespace trailcast::agent
