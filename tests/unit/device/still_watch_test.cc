#include "agent/device/src/still_watch.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class StillWatchTest : public testing::Test {
 protected:
  // Whether the drive is over at the end of so many seconds at that place, ten frames a second.
  bool OverAfter(double for_s, const motion::Pose2& pose) {
    bool over = false;
    const double end_s = now_s_ + for_s;
    for (; now_s_ < end_s; now_s_ += 0.1) over = watch_.Over(FromSeconds(now_s_), pose) || over;
    return over;
  }
  StillWatch watch_{seconds(3)};
  double now_s_ = 0.0;
};

TEST_F(StillWatchTest, ADriveThatHasNotBegunIsNotOver) { EXPECT_FALSE(OverAfter(20.0, {})); }

TEST_F(StillWatchTest, ADriveIsOverWhenTheRobotHasStoodForSoLong) {
  EXPECT_FALSE(OverAfter(5.0, {}));
  EXPECT_FALSE(OverAfter(2.5, {1.0, 0.0, 0.0}));
  EXPECT_TRUE(OverAfter(1.0, {1.0, 0.0, 0.0}));
}

TEST_F(StillWatchTest, APauseIsNoEnd) {
  EXPECT_FALSE(OverAfter(1.0, {}));
  EXPECT_FALSE(OverAfter(2.5, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(OverAfter(2.5, {1.5, 0.0, 0.0}));
  EXPECT_TRUE(OverAfter(3.5, {1.5, 0.0, 0.0}));
}

TEST_F(StillWatchTest, TurningOnTheSpotIsNotStanding) {
  EXPECT_FALSE(OverAfter(1.0, {}));
  for (int turn = 1; turn < 10; ++turn) EXPECT_FALSE(OverAfter(1.0, {0.0, 0.0, 0.1 * turn}));
}

TEST_F(StillWatchTest, TheNoiseOfOdometryIsStanding) {
  EXPECT_FALSE(OverAfter(1.0, {}));
  EXPECT_FALSE(OverAfter(2.0, {1.0, 0.0, 0.0}));
  EXPECT_TRUE(OverAfter(2.0, {1.01, 0.005, 0.01}));
}

TEST_F(StillWatchTest, WithoutALimitItIsNeverOver) {
  watch_ = StillWatch(milliseconds(0));
  EXPECT_FALSE(OverAfter(1.0, {}));
  EXPECT_FALSE(OverAfter(100.0, {1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace trailcast::agent
