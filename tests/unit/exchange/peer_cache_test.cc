#include "services/exchange/peer_cache.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using std::chrono::milliseconds;
using test::Indices;
using test::Only;
using testing::IsEmpty;

class PeerCacheTest : public testing::Test {
 protected:
  PeerCacheTest() { holder_.Hold({key_}); }

  void Ask(const std::string& who, const route::RouteKey& key, std::uint32_t first,
           std::uint32_t end) {
    holder_.Handle(SegmentRequest{AgentId(who), key, Indices(first, end)}, now_);
  }
  std::vector<route::SegmentPiece> SentAfter(milliseconds passed) {
    now_ += passed;
    std::vector<route::SegmentPiece> sent;
    for (const SegmentBatch& batch : Only<SegmentBatch>(holder_.Tick(now_))) {
      EXPECT_EQ(batch.sender, AgentId("robot-7"));
      sent.insert(sent.end(), batch.pieces.begin(), batch.pieces.end());
    }
    return sent;
  }

  const route::RouteKey key_ = test::KeyNumber(1);
  const std::vector<route::SegmentPiece> pieces_ = test::PiecesOf(key_, 4);
  PeerCache::Time now_{};
  PeerCache holder_{
      AgentId("robot-7"),
      [this](const route::RouteKey&, SegmentIndex index) -> Result<route::SegmentPiece> {
        if (index.value() >= pieces_.size()) {
          return Fail(ErrorCode::kNotFound, "no segment {}", index.value());
        }
        return pieces_[index.value()];
      },
      [this](const route::RouteKey& key) -> Result<std::optional<route::RouteInfo>> {
        return test::InfoOf(key, pieces_, route::RouteState::kComplete);
      },
      {.patience = milliseconds(100)}};
};

TEST_F(PeerCacheTest, AnswersWhatTheSameAgentAskedForTwice) {
  Ask("server", key_, 1, 3);
  EXPECT_THAT(SentAfter(milliseconds(1000)), IsEmpty());
  Ask("other", key_, 1, 3);
  EXPECT_THAT(SentAfter(milliseconds(1000)), IsEmpty());
  Ask("server", key_, 2, 3);
  EXPECT_THAT(SentAfter(milliseconds(99)), IsEmpty()) << "others may answer first";
  EXPECT_EQ(SentAfter(milliseconds(101)), std::vector{pieces_[2]});
  EXPECT_THAT(SentAfter(milliseconds(1000)), IsEmpty()) << "once";
}

TEST_F(PeerCacheTest, WhatABlockedLinkDidNotTakeIsLentLaterUnlessSomebodyElseDid) {
  Ask("server", key_, 0, 2);
  Ask("server", key_, 0, 2);
  now_ += milliseconds(200);
  const auto lent = holder_.Tick(now_);
  ASSERT_EQ(test::PiecesIn(lent).size(), 2U);
  for (const Message& message : lent) holder_.NotSent(message, now_);
  holder_.Handle(SegmentBatch{AgentId("scout-1"), {pieces_[0]}}, now_);
  EXPECT_EQ(SentAfter(milliseconds(100)), std::vector{pieces_[1]});
}

TEST_F(PeerCacheTest, LeavesItToWhoeverAnswersFirst) {
  Ask("server", key_, 0, 2);
  Ask("server", key_, 0, 2);
  holder_.Handle(SegmentBatch{AgentId("scout-1"), {pieces_[0]}}, now_);
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{pieces_[1]});
}

TEST_F(PeerCacheTest, ListensToOthersForAWhileOnceItWasAskedInVain) {
  EXPECT_THAT(holder_.ListensTo(now_), IsEmpty());
  Ask("server", key_, 0, 1);
  EXPECT_THAT(holder_.ListensTo(now_), IsEmpty()) << "left to others, who need not be heard";
  Ask("server", key_, 0, 1);
  EXPECT_THAT(holder_.ListensTo(now_), testing::ElementsAre(key_));
  EXPECT_THAT(holder_.ListensTo(now_ + milliseconds(9999)), testing::ElementsAre(key_));
  EXPECT_THAT(holder_.ListensTo(now_ + milliseconds(10'000)), IsEmpty());
}

TEST_F(PeerCacheTest, TellsADigestThatWasAskedForInVainUnlessAnotherDoes) {
  const SegmentRequest knock{AgentId("robot-1"), key_, Indices(2, 3), true};
  route::SegmentPiece named = pieces_[2];
  named.bytes.clear();
  for (int time = 0; time < 2; ++time) holder_.Handle(knock, now_);
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{named});
  for (int time = 0; time < 2; ++time) holder_.Handle(knock, now_);
  holder_.Handle(SegmentBatch{AgentId("robot-2"), {named}}, now_);
  EXPECT_THAT(SentAfter(milliseconds(200)), IsEmpty());
}

TEST_F(PeerCacheTest, ADigestIsNoAnswerToWhoAskedForTheSegment) {
  for (const bool digests_only : {true, false, true, false}) {
    holder_.Handle(SegmentRequest{AgentId("robot-1"), key_, Indices(2, 3), digests_only}, now_);
  }
  route::SegmentPiece named = pieces_[2];
  named.bytes.clear();
  holder_.Handle(SegmentBatch{AgentId("robot-2"), {named}}, now_);
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{pieces_[2]});
}

TEST_F(PeerCacheTest, WhileAServerIsThereItLendsToServersOnly) {
  AgentStatus server;
  server.agent = AgentId("server");
  server.instance = 5;
  server.role = AgentRole::kServer;
  holder_.Handle(server, now_);
  for (int time = 0; time < 2; ++time) {
    Ask("robot-1", key_, 0, 1);
    Ask("server", key_, 1, 2);
  }
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{pieces_[1]});
  holder_.Handle(AgentGone{AgentId("server"), 5}, now_);
  Ask("robot-1", key_, 0, 1);
  Ask("robot-1", key_, 0, 1);
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{pieces_[0]});
}

TEST_F(PeerCacheTest, AnswersForWholeRevisionsOnlyAndForWhatItCanRead) {
  const route::RouteKey other = test::KeyNumber(2);
  for (int time = 0; time < 2; ++time) {
    Ask("server", other, 0, 1);
    Ask("server", key_, 3, 9);
  }
  EXPECT_EQ(SentAfter(milliseconds(200)), std::vector{pieces_[3]});
}

TEST_F(PeerCacheTest, AFloodOfRequestsIsNotRememberedWithoutEnd) {
  int read = 0;
  PeerCache holder(AgentId("robot-7"),
                   [&](const route::RouteKey&, SegmentIndex) -> Result<route::SegmentPiece> {
                     ++read;
                     return Fail(ErrorCode::kNotFound, "made up");
                   });
  holder.Hold({key_});
  for (std::uint32_t first = 0; first < 50'000; first += 1000) {
    for (int time = 0; time < 2; ++time) {
      holder.Handle(SegmentRequest{AgentId("server"), key_, Indices(first, first + 1000)}, now_);
    }
  }
  (void)holder.Tick(now_ + milliseconds(1000));
  EXPECT_EQ(read, 16'384);
}

TEST_F(PeerCacheTest, SendsALongAnswerInParts) {
  const auto many = test::PiecesOf(key_, 64, 5000);
  PeerCache holder(AgentId("robot-7"),
                   [&](const route::RouteKey&, SegmentIndex index) -> Result<route::SegmentPiece> {
                     return many[index.value()];
                   });
  holder.Hold({key_});
  for (int time = 0; time < 2; ++time) {
    holder.Handle(SegmentRequest{AgentId("server"), key_, Indices(0, 64)}, now_);
  }
  now_ += milliseconds(1000);
  std::size_t ticks = 0;
  std::size_t sent = 0;
  for (; sent < many.size() && ticks < 100; ++ticks) {
    for (const SegmentBatch& batch : Only<SegmentBatch>(holder.Tick(now_))) {
      sent += batch.pieces.size();
    }
  }
  EXPECT_EQ(sent, many.size());
  EXPECT_GE(ticks, 4U);
}

TEST_F(PeerCacheTest, TellsAServerThatLacksARouteAllAboutIt) {
  const SegmentRequest who_has{AgentId("server"), key_, {}};
  holder_.Handle(who_has, now_);
  now_ += milliseconds(1000);
  EXPECT_THAT(holder_.Tick(now_), IsEmpty()) << "not known to be a server";
  AgentStatus server{.agent = AgentId("server"), .instance = 1};
  server.role = AgentRole::kServer;
  holder_.Handle(server, now_);
  holder_.Handle(who_has, now_);
  now_ += milliseconds(200);
  const auto told = Only<RouteAnnouncement>(holder_.Tick(now_));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].info, test::InfoOf(key_, pieces_, route::RouteState::kComplete));
  holder_.Handle(who_has, now_);
  holder_.Handle(RouteAnnouncement{AgentId("other"), told[0].info}, now_);
  now_ += milliseconds(1000);
  EXPECT_THAT(holder_.Tick(now_), IsEmpty()) << "another one did";
}

}  // namespace
}  // namespace trailcast::exchange
