#include "services/exchange/answer_queue.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::Indices;
using test::KeyNumber;

constexpr AnswerQueue::Time kStart{};
constexpr std::size_t kPlenty = 1'000'000;

Result<route::SegmentPiece> Read(const route::RouteKey& key, SegmentIndex index) {
  return test::PieceOf(key, index.value(), 100);
}

TEST(AnswerQueue, AnswersAllWhoAskWithinTheWindowOnce) {
  AnswerQueue queue({.window = milliseconds(50)});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  queue.Ask(KeyNumber(1), Indices(1, 5), kStart + milliseconds(40));
  EXPECT_TRUE(queue.Due(kStart + milliseconds(49), kPlenty, Read).pieces.empty());
  EXPECT_EQ(queue.Due(kStart + milliseconds(50), kPlenty, Read).pieces,
            test::PiecesOf(KeyNumber(1), 5, 100));
  EXPECT_TRUE(queue.empty());
}

TEST(AnswerQueue, WhatIsOnItsWayIsNotSentAgainUntilAskedForLater) {
  AnswerQueue queue({.window = milliseconds(50), .on_its_way = milliseconds(800)});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  const auto sent_at = kStart + milliseconds(50);
  EXPECT_EQ(queue.Due(sent_at, kPlenty, Read).pieces.size(), 3U);
  queue.Ask(KeyNumber(1), Indices(0, 3), sent_at + milliseconds(799));
  EXPECT_TRUE(queue.empty());
  EXPECT_TRUE(queue.Due(sent_at + milliseconds(799), kPlenty, Read).pieces.empty());
  queue.Ask(KeyNumber(1), Indices(0, 3), sent_at + milliseconds(800));
  EXPECT_EQ(queue.Due(sent_at + milliseconds(900), kPlenty, Read).pieces.size(), 3U);
}

TEST(AnswerQueue, WhoeverIsBeingAnsweredNeedNotWaitForOthers) {
  AnswerQueue queue({.window = milliseconds(50)});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  (void)queue.Due(kStart + milliseconds(50), kPlenty, Read);
  queue.Ask(KeyNumber(1), Indices(3, 5), kStart + milliseconds(60));
  EXPECT_EQ(queue.Due(kStart + milliseconds(60), kPlenty, Read).pieces.size(), 2U);
}

TEST(AnswerQueue, SendsALongAnswerInTurns) {
  AnswerQueue queue({.window = milliseconds(0)});
  queue.Ask(KeyNumber(1), Indices(0, 5), kStart);
  EXPECT_EQ(queue.Due(kStart, 200, Read).pieces.size(), 2U);
  EXPECT_EQ(queue.Due(kStart, 200, Read).pieces.size(), 2U);
  EXPECT_TRUE(queue.IsDue(kStart));
  EXPECT_EQ(queue.Due(kStart, 200, Read).pieces.size(), 1U);
  EXPECT_FALSE(queue.IsDue(kStart));
}

TEST(AnswerQueue, IsNotDueWhileOthersMayAskOrTheLinkIsBlocked) {
  AnswerQueue queue({.window = milliseconds(50), .again_after = milliseconds(30)});
  queue.Ask(KeyNumber(1), Indices(0, 1), kStart);
  EXPECT_FALSE(queue.IsDue(kStart + milliseconds(49)));
  const auto sent_at = kStart + milliseconds(50);
  EXPECT_TRUE(queue.IsDue(sent_at));
  (void)queue.Due(sent_at, kPlenty, Read);
  queue.PutBack(KeyNumber(1), SegmentIndex(0), sent_at);
  EXPECT_FALSE(queue.IsDue(sent_at + milliseconds(29)));
  EXPECT_TRUE(queue.IsDue(sent_at + milliseconds(30)));
}

TEST(AnswerQueue, ReportsWhatCannotBeReadAndSendsTheRest) {
  AnswerQueue queue({.window = milliseconds(0)});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  const auto damaged = [](const route::RouteKey& key,
                          SegmentIndex index) -> Result<route::SegmentPiece> {
    if (index == SegmentIndex(1)) return Fail(ErrorCode::kCorrupt, "damaged");
    return Read(key, index);
  };
  const auto answers = queue.Due(kStart, kPlenty, damaged);
  EXPECT_EQ(answers.pieces.size(), 2U);
  ASSERT_EQ(answers.unreadable.size(), 1U);
  EXPECT_EQ(answers.unreadable[0].error.message, "damaged");
}

TEST(AnswerQueue, RoutesAreServedInTurn) {
  AnswerQueue queue({});
  for (const unsigned route : {1U, 2U, 3U}) {
    queue.Ask(test::KeyNumber(route), test::Indices(0, 10), kStart);
  }
  std::vector<route::RouteKey> served;
  const auto read = [](const route::RouteKey& key, SegmentIndex index) {
    return Result<route::SegmentPiece>(test::PieceOf(key, index.value(), 100));
  };
  for (int tick = 0; tick < 6; ++tick) {
    const auto answers = queue.Due(kStart + std::chrono::milliseconds(20 + tick), 300, read);
    ASSERT_EQ(answers.pieces.size(), 3U);
    served.push_back(answers.pieces.front().key);
  }
  using test::KeyNumber;
  EXPECT_EQ(served, (std::vector{KeyNumber(1), KeyNumber(2), KeyNumber(3), KeyNumber(1),
                                 KeyNumber(2), KeyNumber(3)}));
}

TEST(AnswerQueue, WhatIsPutBackIsNotOnItsWayAndSentAfterAPause) {
  AnswerQueue queue({.window = milliseconds(0), .again_after = milliseconds(50)});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  const auto due = queue.Due(kStart, kPlenty, Read);
  ASSERT_EQ(due.pieces.size(), 3U);
  queue.PutBack(KeyNumber(1), SegmentIndex(1), kStart);
  EXPECT_FALSE(queue.empty());
  EXPECT_TRUE(queue.Due(kStart + milliseconds(49), kPlenty, Read).pieces.empty());
  EXPECT_EQ(queue.Due(kStart + milliseconds(50), kPlenty, Read).pieces,
            std::vector{test::PieceOf(KeyNumber(1), 1, 100)});
}

TEST(AnswerQueue, RemembersSoMuchAndNoMore) {
  AnswerQueue queue({.window = milliseconds(0), .on_its_way = milliseconds(800), .most = 4});
  queue.Ask(KeyNumber(1), Indices(0, 3), kStart);
  queue.Ask(KeyNumber(2), Indices(0, 3), kStart);
  auto now = kStart + milliseconds(100);
  EXPECT_EQ(queue.Due(now, kPlenty, Read).pieces.size(), 4U);
  queue.Ask(KeyNumber(3), Indices(0, 1), now);
  EXPECT_TRUE(queue.empty()) << "four are on their way";
  now += milliseconds(800);
  queue.Ask(KeyNumber(3), Indices(0, 9), now);
  EXPECT_EQ(queue.Due(now, kPlenty, Read).pieces.size(), 4U) << "these have arrived or were lost";
}

}  // namespace
}  // namespace trailcast::exchange
