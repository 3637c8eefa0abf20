#include "services/lab/trial/recording/frame_order.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

namespace trailcast::trial {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<Shown> Order(const std::string& disturbance, int frames, std::uint64_t seed = 1) {
  const auto order = OrderOf(*ParseDisturbance(disturbance), frames, seed);
  EXPECT_TRUE(order) << order.error().message;
  return order.value_or(std::vector<Shown>{});
}

std::vector<int> Frames(const std::vector<Shown>& order) {
  std::vector<int> frames;
  for (const Shown& shown : order) frames.push_back(shown.frame);
  return frames;
}

// Cuts are exactly where the frame is not the next one.
void ExpectCutsWhereItDoesNotGoOn(const std::vector<Shown>& order) {
  for (std::size_t i = 1; i < order.size(); ++i) {
    EXPECT_EQ(order[i].cut, order[i].frame != order[i - 1].frame + 1) << i;
  }
}

int CutsIn(const std::vector<Shown>& order) {
  return static_cast<int>(
      std::count_if(order.begin(), order.end(), [](const Shown& shown) { return shown.cut; }));
}

TEST(FrameOrder, UndisturbedIsAsRecorded) {
  EXPECT_THAT(Frames(Order("none", 4)), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(Frames(Order("jpeg+noise", 3)), ElementsAre(0, 1, 2));
}

TEST(FrameOrder, EveryThirdSlowerAndReverse) {
  EXPECT_THAT(Frames(Order("every=3", 8)), ElementsAre(0, 3, 6));
  EXPECT_THAT(Frames(Order("slower=2", 3)), ElementsAre(0, 0, 1, 1, 2, 2));
  EXPECT_THAT(Frames(Order("reverse", 3)), ElementsAre(2, 1, 0));
  EXPECT_THAT(Frames(Order("every=2+reverse", 5)), ElementsAre(4, 2, 0));
}

TEST(FrameOrder, BeginsOnTheWay) {
  EXPECT_THAT(Frames(Order("from=0.4", 5)), ElementsAre(2, 3, 4));
  EXPECT_EQ(CutsIn(Order("from=0.4", 5)), 0);
  EXPECT_THAT(Frames(Order("from=0.95", 5)), ElementsAre(4));
  EXPECT_THAT(Frames(Order("reverse+from=0.5", 4)), ElementsAre(1, 0));
}

TEST(FrameOrder, SkippingLeavesOutSoManyAtThreePlaces) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const auto order = Order("skip=50", 480, seed);
    EXPECT_EQ(order.size(), 330U);
    EXPECT_EQ(CutsIn(order), 3);
    EXPECT_TRUE(GoesForward(order));
    EXPECT_EQ(order.front().frame, 0);
    ExpectCutsWhereItDoesNotGoOn(order);
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (order[i].cut) {
        EXPECT_EQ(order[i].frame, order[i - 1].frame + 51);
      }
    }
  }
}

TEST(FrameOrder, AShortRecordingIsCutOnce) {
  const auto order = Order("skip=50", 111);
  EXPECT_EQ(order.size(), 61U);
  EXPECT_EQ(CutsIn(order), 1);
}

TEST(FrameOrder, JumpsGoElsewhere) {
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    const auto order = Order("jump=3", 400, seed);
    EXPECT_EQ(order.size(), 400U);
    EXPECT_EQ(CutsIn(order), 3);
    ExpectCutsWhereItDoesNotGoOn(order);
    for (std::size_t i = 1; i < order.size(); ++i) {
      ASSERT_GE(order[i].frame, 0);
      ASSERT_LT(order[i].frame, 400);
      if (order[i].cut) {
        EXPECT_GE(std::abs(order[i].frame - order[i - 1].frame - 1), 80);
      }
    }
  }
}

TEST(FrameOrder, IsDrawnFromItsSeedAlone) {
  EXPECT_EQ(Order("jump=3", 400, 7), Order("jump=3", 400, 7));
  EXPECT_NE(Order("jump=3", 400, 7), Order("jump=3", 400, 8));
}

TEST(FrameOrder, CutsStayBetweenTheSamePicturesWhatElseIsDone) {
  const auto jumped = Order("jump=1", 100);
  const auto at = std::find_if(jumped.begin(), jumped.end(), [](const Shown& s) { return s.cut; });
  ASSERT_NE(at, jumped.end());
  EXPECT_EQ(CutsIn(Order("jump=1+slower=3", 100)), 1);
  EXPECT_EQ(CutsIn(Order("jump=1+every=7", 100)), 1);
  const auto back = Order("jump=1+reverse", 100);
  ASSERT_EQ(CutsIn(back), 1);
  const auto there = std::find_if(back.begin(), back.end(), [](const Shown& s) { return s.cut; });
  EXPECT_EQ(there->frame, std::prev(at)->frame);
  EXPECT_EQ(std::prev(there)->frame, at->frame);
}

TEST(FrameOrder, TooShortARecordingIsRefused) {
  const auto refusal = [](const std::string& disturbance, int frames) {
    const auto order = OrderOf(*ParseDisturbance(disturbance), frames, 1);
    return order ? "none" : order.error().message;
  };
  EXPECT_THAT(refusal("skip=50", 99), HasSubstr("99 frames are too few to leave 50 out"));
  EXPECT_THAT(refusal("jump=3", 39), HasSubstr("39 frames are too few for 3 jumps"));
}

TEST(FrameOrder, KnowsWhetherItGoesForward) {
  EXPECT_TRUE(GoesForward(Order("every=3+slower=2", 20)));
  EXPECT_FALSE(GoesForward(Order("reverse", 20)));
}

}  // namespace
}  // namespace trailcast::trial
