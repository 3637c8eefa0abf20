#include "agent/fetch/src/fetch_estimate.h"

#include <gtest/gtest.h>

namespace trailcast::agent {
namespace {

using std::chrono::seconds;

constexpr FetchEstimate::Time kBegan{};

TEST(FetchEstimate, SaysNothingBeforeTheSecondTimeThatSegmentsCame) {
  FetchEstimate estimate;
  EXPECT_FALSE(estimate.Left(100));
  estimate.Note(kBegan + seconds(2), 0);
  EXPECT_FALSE(estimate.Left(100));
  estimate.Note(kBegan + seconds(3), 8);
  EXPECT_FALSE(estimate.Left(100));
}

TEST(FetchEstimate, GoesByTheRateSinceTheFirstSegmentOfThisRun) {
  FetchEstimate estimate;
  estimate.Note(kBegan + seconds(30), 0);
  estimate.Note(kBegan + seconds(60), 10);
  estimate.Note(kBegan + seconds(62), 20);
  ASSERT_TRUE(estimate.Left(40));
  EXPECT_DOUBLE_EQ(estimate.Left(40)->count(), 8.0);
  estimate.Note(kBegan + seconds(64), 30);
  EXPECT_DOUBLE_EQ(estimate.Left(30)->count(), 6.0);
}

TEST(FetchEstimate, ForgetsHowFastItWasLongAgo) {
  FetchEstimate estimate;
  estimate.Note(kBegan + seconds(2), 1000);
  for (int s = 4; s <= 14; s += 2) {
    estimate.Note(kBegan + seconds(s), 1000U + static_cast<std::uint32_t>(s - 2));
  }
  EXPECT_DOUBLE_EQ(estimate.Left(50)->count(), 50.0);
  for (int s = 16; s <= 40; s += 2) estimate.Note(kBegan + seconds(s), 1012);
  EXPECT_FALSE(estimate.Left(50));
}

}  // namespace
}  // namespace trailcast::agent
