#include "services/lab/trial/recording/taught_frames.h"

#include <gtest/gtest.h>

namespace trailcast::trial {
namespace {

TEST(TaughtFrames, ProgressCountsSegmentsEachWithFramesOfItsOwn) {
  const std::vector<FrameSpan> segments{{0, 10}, {10, 40}};
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.0), 0.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.25), 5.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.5), 10.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.75), 25.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 1.0), 40.0);
}

TEST(TaughtFrames, FramesThatTaughtNothingAreLeapt) {
  const std::vector<FrameSpan> segments{{5, 15}, {30, 40}};
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.0), 5.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt(segments, 0.5), 30.0);
}

TEST(TaughtFrames, ProgressBeyondTheRouteIsItsEnd) {
  EXPECT_DOUBLE_EQ(TaughtFrameAt({{0, 10}}, 1.2), 10.0);
  EXPECT_DOUBLE_EQ(TaughtFrameAt({{3, 10}}, -0.1), 3.0);
}

}  // namespace
}  // namespace trailcast::trial
