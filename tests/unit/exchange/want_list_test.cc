#include "services/exchange/want_list.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::Indices;

constexpr WantList::Options kOptions{milliseconds(100), milliseconds(400), 4};
constexpr WantList::Time kStart{};

WantList Wanting(std::uint32_t count) {
  WantList list(kOptions);
  for (const SegmentIndex index : Indices(0, count)) list.Want(index, kStart);
  return list;
}

TEST(WantList, AsksLowestFirstAndNeverForWhatIsUnderWay) {
  WantList list = Wanting(6);
  EXPECT_EQ(list.Due(kStart), Indices(0, 4));
  EXPECT_TRUE(list.Due(kStart + milliseconds(99)).empty());
  list.Remove(SegmentIndex(0));
  list.Remove(SegmentIndex(1));
  EXPECT_EQ(list.Due(kStart + milliseconds(99)), Indices(4, 6));
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
