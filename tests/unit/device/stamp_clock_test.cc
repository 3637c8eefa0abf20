#include "agent/device/stamp_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

constexpr milliseconds kStampFrame{33};

// A sensor that samples every 33 ms; samples are under way for 20 ms.
class StampClockTest : public testing::Test {
 protected:
  SensorTime Next() {
    now_ += kStampFrame;
    stamp_ += kStampFrame;
    return clock_.Follow(stamp_, now_ + milliseconds(20)).value();
  }
  // Expects ten samples, each so much later than the one before.
  void ExpectGoesOn(SensorTime from) {
    SensorTime before = from;
    for (int i = 0; i < 10; ++i) {
      const SensorTime taken = Next();
      EXPECT_EQ(taken - before, kStampFrame);
      before = taken;
    }
  }

  StampClock clock_;
  StampClock::Time now_{seconds(500)};
  SensorTime stamp_ = seconds(1'700'000'000);
};

TEST_F(StampClockTest, LeavesStampsThatGoForward) {
  for (int i = 0; i < 10; ++i) EXPECT_EQ(Next(), stamp_);
  now_ += seconds(60);
  stamp_ += seconds(60);
  EXPECT_EQ(Next(), stamp_) << "after a silence";
  EXPECT_EQ(clock_.TakeNews(), "");
}

TEST_F(StampClockTest, LeavesASimulatorsClockThatPauses) {
  EXPECT_EQ(Next(), stamp_);
  now_ += seconds(60);
  EXPECT_EQ(Next(), stamp_);
  EXPECT_EQ(clock_.TakeNews(), "");
}

TEST_F(StampClockTest, GoesOnOverAStepBackOrAhead) {
  for (const seconds step : {seconds(-100), seconds(3600), seconds(-2)}) {
    SensorTime before = Next();
    stamp_ += step;
    ExpectGoesOn(before);
    EXPECT_THAT(clock_.TakeNews(), HasSubstr(step < seconds(0) ? "went back" : "went ahead"));
    EXPECT_EQ(clock_.TakeNews(), "");
  }
}

TEST_F(StampClockTest, GoesByTheTimeOfArrivalWhereStampsStandStill) {
  SensorTime before = Next();
  for (int i = 0; i < 10; ++i) {
    now_ += kStampFrame;
    const auto taken = clock_.Follow(stamp_, now_ + milliseconds(20));
    ASSERT_TRUE(taken);
    EXPECT_EQ(*taken - before, kStampFrame);
    before = *taken;
  }
  EXPECT_TRUE(clock_.stands());
  EXPECT_THAT(clock_.TakeNews(), HasSubstr("stand still"));
  ExpectGoesOn(before);
  EXPECT_FALSE(clock_.stands());
}

TEST_F(StampClockTest, LeavesOutWhatComesOutOfTurn) {
  (void)Next();
  EXPECT_FALSE(clock_.Follow(stamp_ - milliseconds(10), now_ + milliseconds(25)));
  EXPECT_EQ(Next(), stamp_);
}

TEST_F(StampClockTest, KnowsHowFarBehindTheQuickestSampleWas) {
  (void)Next();
  const auto expected = now_.time_since_epoch() + milliseconds(20) - stamp_;
  (void)clock_.Follow(stamp_ + kStampFrame, now_ + kStampFrame + milliseconds(400));
  EXPECT_EQ(clock_.TakeBehind(), expected);
  EXPECT_EQ(clock_.TakeBehind(), std::nullopt);
}

}  // namespace
}  // namespace trailcast::agent
