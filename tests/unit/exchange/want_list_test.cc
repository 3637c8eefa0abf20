#include "services/exchange/want_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::Indices;

constexpr WantList::Options kOptions{.retry_after = milliseconds(100),
                                     .retry_at_most = milliseconds(400),
                                     .first_under_way = 4,
                                     .least_under_way = 2,
                                     .most_under_way = 8,
                                     .quick_answer = milliseconds(20),
                                     .slow_answer = milliseconds(50)};
constexpr WantList::Time kStart{};

WantList Wanting(std::uint32_t count) {
  WantList list(kOptions);
  for (const SegmentIndex index : Indices(0, count)) list.Want(index, kStart);
  return list;
}

TEST(WantList, AsksLowestFirstAndNeverForWhatIsUnderWay) {
  WantList list = Wanting(6);
  EXPECT_EQ(list.Due(kStart), Indices(0, 4));
  EXPECT_TRUE(list.Due(kStart + milliseconds(30)).empty());
  list.Arrived(SegmentIndex(0), kStart + milliseconds(30));
  list.Arrived(SegmentIndex(1), kStart + milliseconds(30));
  EXPECT_EQ(list.Due(kStart + milliseconds(30)), Indices(4, 6));
}

TEST(WantList, HasHalfAsManyUnderWayAfterSomeDidNotCome) {
  WantList list = Wanting(20);
  EXPECT_EQ(list.Due(kStart), Indices(0, 4));
  const WantList::Time later = kStart + milliseconds(101);
  EXPECT_EQ(list.Due(later), Indices(0, 4));  // once more
  for (const SegmentIndex index : Indices(0, 4)) list.Arrived(index, later);
  EXPECT_EQ(list.Due(later), Indices(4, 6));
}

// Fetches with a link that brings a segment every so often, and nothing at first; how many were
// under way at most in the end.
std::size_t UnderWayWithASegmentEvery(milliseconds every) {
  WantList list = Wanting(1000);
  std::vector<SegmentIndex> asked;
  std::size_t most = 0;
  std::size_t next = 0;
  for (auto now = kStart; now < kStart + 200 * every; now += every) {
    const auto due = list.Due(now);
    asked.insert(asked.end(), due.begin(), due.end());
    if (now >= kStart + 100 * every) most = std::max(most, asked.size() - next);
    list.Arrived(asked.at(next++), now + every);
  }
  return most;
}

TEST(WantList, KeepsAsMuchUnderWayAsTheLinkBringsInAShortTime) {
  EXPECT_EQ(UnderWayWithASegmentEvery(milliseconds(1)), 8U);
  const std::size_t at_medium = UnderWayWithASegmentEvery(milliseconds(8));
  EXPECT_GE(at_medium * 8, 20U);
  EXPECT_LE(at_medium * 8, 60U);
  EXPECT_EQ(UnderWayWithASegmentEvery(milliseconds(60)), 2U);
}

TEST(WantList, AsksForNothingAgainWhileASlowLinkBringsAnswers) {
  WantList list = Wanting(4);
  EXPECT_EQ(list.Due(kStart), Indices(0, 4));
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto now = kStart + milliseconds(90 * (i + 1));
    EXPECT_TRUE(list.Due(now).empty());
    list.Arrived(SegmentIndex(i), now);
  }
  EXPECT_TRUE(list.empty());
}

TEST(WantList, WhatLaterRequestsOvertakeIsAskedForAgainAfterTheTimeout) {
  WantList list = Wanting(100);
  (void)list.Due(kStart);
  std::uint32_t next = 1;
  for (auto now = kStart + milliseconds(1); now < kStart + milliseconds(100);
       now += milliseconds(1)) {
    if (next < 50) list.Arrived(SegmentIndex(next++), now);
    EXPECT_THAT(list.Due(now), testing::Not(testing::Contains(SegmentIndex(0))));
  }
  EXPECT_THAT(list.Due(kStart + milliseconds(100)), testing::Contains(SegmentIndex(0)));
}

TEST(WantList, AsksForManyAtATime) {
  WantList::Options options = kOptions;
  options.first_under_way = options.most_under_way;
  WantList list(options);
  for (const SegmentIndex index : Indices(0, 100)) list.Want(index, kStart);
  EXPECT_EQ(list.Due(kStart), Indices(0, 8));
  list.Arrived(SegmentIndex(0), kStart);
  EXPECT_TRUE(list.Due(kStart).empty());
  list.Arrived(SegmentIndex(1), kStart);
  EXPECT_EQ(list.Due(kStart), Indices(8, 10));
}

TEST(WantList, ForgetsWhatLiesBeyondTheEnd) {
  WantList list = Wanting(10);
  (void)list.Due(kStart);
  list.Truncate(7);
  EXPECT_TRUE(list.contains(SegmentIndex(6)));
  EXPECT_FALSE(list.contains(SegmentIndex(7)));
  list.Truncate(2);
  EXPECT_TRUE(list.contains(SegmentIndex(1)));
  EXPECT_FALSE(list.contains(SegmentIndex(2)));
  list.Truncate(0);
  EXPECT_TRUE(list.empty());
}

TEST(WantList, WhatComesUnaskedIsNotAskedFor) {
  WantList list = Wanting(8);
  for (const std::uint32_t i : {0U, 3U, 7U}) list.Arrived(SegmentIndex(i), kStart);
  EXPECT_EQ(list.first(), SegmentIndex(1));
  list.Want(SegmentIndex(1), kStart);  // it is already
  const std::vector<SegmentIndex> rest{SegmentIndex(1), SegmentIndex(2), SegmentIndex(4),
                                       SegmentIndex(5)};
  EXPECT_EQ(list.Due(kStart), rest);
  EXPECT_TRUE(list.contains(SegmentIndex(6)));
  EXPECT_FALSE(list.contains(SegmentIndex(7)));
}

TEST(WantList, NobodyAnsweringBoundsWhatIsAskedFor) {
  WantList::Options options = kOptions;
  options.retry_at_most = std::chrono::hours(1);
  WantList list(options);
  for (const SegmentIndex index : Indices(0, 1000)) list.Want(index, kStart);
  std::set<SegmentIndex> asked;
  for (auto now = kStart; now < kStart + milliseconds(100'000); now += milliseconds(50)) {
    for (const SegmentIndex index : list.Due(now)) asked.insert(index);
  }
  EXPECT_EQ(asked.size(), 4 * kOptions.most_under_way);
}

TEST(WantList, AsksAgainAfterTimeoutsThatDoubleUpToALimit) {
  WantList list = Wanting(1);
  std::vector<int> asked_at_ms;
  for (int ms = 0; ms < 2000; ++ms) {
    if (!list.Due(kStart + milliseconds(ms)).empty()) asked_at_ms.push_back(ms);
  }
  EXPECT_EQ(asked_at_ms, (std::vector<int>{0, 100, 300, 700, 1100, 1500, 1900}));
}

TEST(WantList, WaitsForWhatMayBeComingAnyway) {
  WantList list(kOptions);
  list.Want(SegmentIndex(0), kStart + milliseconds(50));
  list.Hurry(kStart);  // it was never asked for in vain
  EXPECT_TRUE(list.Due(kStart + milliseconds(49)).empty());
  EXPECT_FALSE(list.Due(kStart + milliseconds(50)).empty());
}

TEST(WantList, BadBytesAreAskedForAtOnceButOnlyOnce) {
  WantList list = Wanting(1);
  (void)list.Due(kStart);
  list.AskAgain(SegmentIndex(0), kStart);
  EXPECT_FALSE(list.Due(kStart).empty());
  list.AskAgain(SegmentIndex(0), kStart);
  EXPECT_TRUE(list.Due(kStart).empty());
}

TEST(WantList, AHolderThatReturnsIsAskedAtOnce) {
  WantList list = Wanting(1);
  for (int ms = 0; ms <= 700; ++ms) (void)list.Due(kStart + milliseconds(ms));
  const auto later = kStart + milliseconds(900);
  EXPECT_TRUE(list.Due(later).empty());
  list.Hurry(later);
  EXPECT_FALSE(list.Due(later).empty());
}

}  // namespace
}  // namespace trailcast::exchange
