#include "services/exchange/route_fetcher.h"

#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteState;
using std::chrono::milliseconds;
using test::Indices;
using test::Only;

class RouteFetcherTest : public testing::Test {
 protected:
  RouteFetcher Fetcher(std::uint32_t held = 0) {
    std::vector<RouteFetcher::Held> pieces;
    for (std::uint32_t i = 0; i < held; ++i) {
      pieces.push_back({SegmentIndex(i), pieces_[i].digest});
    }
    RouteFetcherOptions options;
    options.knock_for = milliseconds(0);
    return {AgentId("follower-1"), key_, pieces, test::ToyIntegrity(), now_, options};
  }
  // One that has just begun to listen.
  RouteFetcher NewListener() {
    return {AgentId("follower-1"), key_, {}, test::ToyIntegrity(), now_};
  }
  // Returns what it asks for, a digest alone with a '?': "0?", "0 1 2".
  std::string SaidAfter(RouteFetcher& fetcher, milliseconds passed) {
    now_ += passed;
    std::string said;
    for (const auto& request : Only<SegmentRequest>(fetcher.Tick(now_))) {
      for (const SegmentIndex index : request.lacking) {
        said += (said.empty() ? "" : " ") + std::to_string(index.value());
        if (request.digests_only) said += "?";
      }
    }
    return said;
  }
  void DeliverDigest(RouteFetcher& fetcher, std::uint32_t index) {
    route::SegmentPiece named = pieces_[index];
    named.bytes.clear();
    Deliver(fetcher, named);
  }
  void Announce(RouteFetcher& fetcher, std::uint32_t count,
                RouteState state = RouteState::kTeaching) {
    const auto info = test::InfoOf(key_, std::span(pieces_).first(count), state);
    fetcher.Handle(RouteAnnouncement{AgentId("server-1"), info}, now_);
  }
  void Deliver(RouteFetcher& fetcher, const route::SegmentPiece& piece) {
    fetcher.Handle(SegmentBatch{AgentId("server-1"), {piece}}, now_);
  }
  // Lends as a follower does whose keys say that it is one.
  void Lend(RouteFetcher& fetcher, const std::vector<route::SegmentPiece>& pieces) {
    fetcher.Handle(SegmentBatch{.sender = AgentId("follower-2"),
                                .pieces = pieces,
                                .trust = SegmentBatch::Trust::kProof},
                   now_);
  }
  std::vector<SegmentIndex> AskedAfter(RouteFetcher& fetcher, milliseconds passed) {
    now_ += passed;
    std::vector<SegmentIndex> asked;
    for (const auto& request : Only<SegmentRequest>(fetcher.Tick(now_))) {
      EXPECT_EQ(request.key, key_);
      EXPECT_LE(request.lacking.size(), kMaxIndicesPerRequest);
      asked.insert(asked.end(), request.lacking.begin(), request.lacking.end());
    }
    return asked;
  }

  const route::RouteKey key_ = test::KeyNumber(1);
  const std::vector<route::SegmentPiece> pieces_ = test::PiecesOf(key_, 300);
  RouteFetcher::Time now_{};
};

TEST_F(RouteFetcherTest, OfWhatAnotherRevisionHasItAsksForDigestsOnly) {
  RouteFetcherOptions options;
  options.knock_for = milliseconds(0);
  options.own_content = [this](const route::Digest& digest) -> std::optional<route::Bytes> {
    if (digest == pieces_[1].digest) return pieces_[1].bytes;
    return std::nullopt;
  };
  RouteFetcher fetcher(AgentId("follower-1"), key_, {}, test::ToyIntegrity(), now_, options);
  Announce(fetcher, 3, RouteState::kComplete);
  now_ += milliseconds(200);
  auto asked = Only<SegmentRequest>(fetcher.Tick(now_));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_TRUE(asked[0].digests_only);
  EXPECT_EQ(asked[0].lacking, Indices(0, 3));
  for (route::SegmentPiece piece : {pieces_[0], pieces_[1]}) {
    piece.bytes.clear();
    Deliver(fetcher, piece);
  }
  EXPECT_EQ(fetcher.TakeArrived(), std::vector{pieces_[1]});
  asked = Only<SegmentRequest>(fetcher.Tick(now_));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_FALSE(asked[0].digests_only);
  EXPECT_EQ(asked[0].lacking, Indices(0, 1));
  // Segment 2's digest was lost, or its holder tells none: its bytes will do.
  now_ += milliseconds(1000);
  asked = Only<SegmentRequest>(fetcher.Tick(now_));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_FALSE(asked[0].digests_only);
  for (const std::uint32_t i : {0U, 2U}) Deliver(fetcher, pieces_[i]);
  EXPECT_TRUE(fetcher.Complete());
}

TEST_F(RouteFetcherTest, KnocksUntilAHolderIsHeardAndThenAsks) {
  RouteFetcher fetcher = NewListener();
  Announce(fetcher, 3, RouteState::kComplete);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(0)), "0?");
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(99)), "");
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(1)), "0?");
  DeliverDigest(fetcher, 0);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(10)), "0 1 2");
}

TEST_F(RouteFetcherTest, WhatNobodyTellsTheDigestOfIsAskedForAfterASecond) {
  RouteFetcher fetcher = NewListener();
  Announce(fetcher, 2, RouteState::kComplete);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(SaidAfter(fetcher, milliseconds(i > 0 ? 100 : 0)), "0?");
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(100)), "0 1");
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(500)), "") << "knocked long enough";
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(500)), "0 1");
}

TEST_F(RouteFetcherTest, KnocksAgainAfterSilenceWhenAHolderShowsUp) {
  RouteFetcher fetcher = NewListener();
  Announce(fetcher, 2, RouteState::kComplete);
  Deliver(fetcher, pieces_[0]);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(10)), "1");
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(1000)), "1?") << "its writer may be gone";
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(1000)), "1");
  now_ += milliseconds(1500);
  Announce(fetcher, 2, RouteState::kComplete);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(10)), "1?") << "another one's is not known yet";
  DeliverDigest(fetcher, 1);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(10)), "1");
}

TEST_F(RouteFetcherTest, DoesNotKnockWhenItLacksNothing) {
  RouteFetcher fetcher = NewListener();
  Deliver(fetcher, pieces_[0]);
  Announce(fetcher, 1);
  EXPECT_EQ(SaidAfter(fetcher, milliseconds(3000)), "");
}

TEST_F(RouteFetcherTest, WhatIsLentIsGivenOutOnceTheManifestProvesIt) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 3, RouteState::kComplete);
  Lend(fetcher, {pieces_[0], pieces_[2]});
  EXPECT_TRUE(fetcher.TakeArrived().empty());
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(1, 2));
  Deliver(fetcher, pieces_[1]);
  EXPECT_TRUE(fetcher.Complete());
  EXPECT_EQ(fetcher.TakeArrived().size(), 3U);
}

TEST_F(RouteFetcherTest, SoMuchIsBorrowedAndNoMore) {
  RouteFetcherOptions options;
  options.most_borrowed_bytes = 250;  // two pieces of 100
  RouteFetcher fetcher(AgentId("follower-1"), key_, {}, test::ToyIntegrity(), now_, options);
  Announce(fetcher, 4, RouteState::kComplete);
  Lend(fetcher, {pieces_[0], pieces_[1], pieces_[2]});
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(2, 4));
  Deliver(fetcher, pieces_[0]);
  Lend(fetcher, {pieces_[2]});
  Deliver(fetcher, pieces_[3]);
  EXPECT_TRUE(fetcher.Complete()) << "what is given, not lent, makes room";
}

TEST_F(RouteFetcherTest, WhatIsLentAndProvesWrongIsAskedForAgainAndNoMoreIsBorrowed) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 2, RouteState::kComplete);
  const route::SegmentPiece forged{key_, SegmentIndex(1), pieces_[7].digest, pieces_[7].bytes};
  Lend(fetcher, {pieces_[0], forged});
  EXPECT_FALSE(fetcher.Complete());
  EXPECT_EQ(fetcher.Progress(now_).bad_pieces, 2U);
  Lend(fetcher, {pieces_[0], forged});
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(0, 2));
  Deliver(fetcher, pieces_[0]);
  Deliver(fetcher, pieces_[1]);
  EXPECT_TRUE(fetcher.Complete());
  EXPECT_EQ(fetcher.TakeArrived(), std::vector({pieces_[0], pieces_[1]}));
}

TEST_F(RouteFetcherTest, NothingIsBorrowedOfARouteThatIsBeingTaught) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 2);
  Lend(fetcher, {pieces_[0]});
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(0, 2));
}

TEST_F(RouteFetcherTest, ADigestAloneIsNoSegment) {
  RouteFetcher fetcher = Fetcher(0);
  Announce(fetcher, 1, RouteState::kComplete);
  route::SegmentPiece named = pieces_[0];
  named.bytes.clear();
  Deliver(fetcher, named);
  EXPECT_FALSE(fetcher.Complete());
  EXPECT_EQ(fetcher.Progress(now_).bad_pieces, 0U);
}

TEST_F(RouteFetcherTest, AsksForWhatItLacksAndIsCompleteWhenTheManifestIsRight) {
  RouteFetcher fetcher = Fetcher(2);
  Announce(fetcher, 5, RouteState::kComplete);
  EXPECT_EQ(fetcher.NextMissing(), SegmentIndex(2));
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(2, 5));
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kFetching);
  for (const std::uint32_t i : {4U, 2U, 3U}) Deliver(fetcher, pieces_[i]);
  EXPECT_EQ(fetcher.TakeArrived(), (std::vector{pieces_[4], pieces_[2], pieces_[3]}));
  EXPECT_TRUE(fetcher.Complete());
  EXPECT_FALSE(fetcher.NextMissing());
  EXPECT_TRUE(fetcher.TakeArrived().empty());
}

TEST_F(RouteFetcherTest, AsksAtOnceForARouteThatWasTaughtBefore) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 3, RouteState::kComplete);
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(0)), Indices(0, 3));
}

TEST_F(RouteFetcherTest, DoesNotAskForWhatIsBeingStreamed) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 1);
  EXPECT_TRUE(AskedAfter(fetcher, milliseconds(100)).empty());
  Deliver(fetcher, pieces_[0]);
  EXPECT_TRUE(AskedAfter(fetcher, milliseconds(500)).empty());
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kUpToDate);
}

TEST_F(RouteFetcherTest, TakesSegmentsThatComeBeforeTheirAnnouncement) {
  RouteFetcher fetcher = Fetcher();
  Deliver(fetcher, pieces_[0]);
  EXPECT_EQ(fetcher.TakeArrived().size(), 1U);
  Announce(fetcher, 1, RouteState::kComplete);
  EXPECT_TRUE(fetcher.Complete());
}

TEST_F(RouteFetcherTest, DropsDamagedPiecesAndAsksAgainAtOnce) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 1);
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(0, 1));
  route::SegmentPiece damaged = pieces_[0];
  damaged.bytes[50] ^= 1U;
  Deliver(fetcher, damaged);
  EXPECT_TRUE(fetcher.TakeArrived().empty());
  EXPECT_EQ(fetcher.Progress(now_).bad_pieces, 1U);
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(0)), Indices(0, 1));
}

TEST_F(RouteFetcherTest, CountsDuplicatesAndContradictionsAndKeepsTheFirst) {
  RouteFetcher fetcher = Fetcher();
  Deliver(fetcher, pieces_[0]);
  Deliver(fetcher, pieces_[0]);
  Deliver(fetcher, test::PieceOf(key_, 0, 100, 99));
  EXPECT_EQ(fetcher.TakeArrived(), std::vector{pieces_[0]});
  EXPECT_EQ(fetcher.Progress(now_).duplicate_pieces, 1U);
  EXPECT_EQ(fetcher.Progress(now_).conflicting, 1U);
}

TEST_F(RouteFetcherTest, IgnoresOtherRoutes) {
  RouteFetcher fetcher = Fetcher();
  Deliver(fetcher, test::PieceOf(test::KeyNumber(2), 0));
  Deliver(fetcher, test::PieceOf(test::KeyNumber(1, 2), 0));
  EXPECT_TRUE(fetcher.TakeArrived().empty());
  EXPECT_EQ(fetcher.Progress(now_).held, 0U);
}

TEST_F(RouteFetcherTest, AsksForALongRouteBitByBit) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 300);
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(200)), Indices(0, 8));
  for (std::uint32_t i = 0; i < 6; ++i) Deliver(fetcher, pieces_[i]);
  // Each quick answer lets one more be under way.
  EXPECT_EQ(AskedAfter(fetcher, milliseconds(10)), Indices(8, 20));
}

TEST_F(RouteFetcherTest, NoticesThatNobodyHoldsTheRouteAndAsksWhoDoes) {
  RouteFetcher fetcher = Fetcher();
  const auto start = now_;
  now_ += milliseconds(200);
  const auto inquiry = Only<SegmentRequest>(fetcher.Tick(now_));
  ASSERT_EQ(inquiry.size(), 1U);
  EXPECT_TRUE(inquiry[0].lacking.empty());
  EXPECT_TRUE(fetcher.Tick(now_ + milliseconds(1000)).empty());
  EXPECT_EQ(fetcher.Tick(now_ + milliseconds(5000)).size(), 1U);
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kWaiting);
  EXPECT_EQ(fetcher.Progress(now_).waiting_since, start);
}

TEST_F(RouteFetcherTest, WaitsWhenTheHolderFallsSilent) {
  RouteFetcher fetcher = Fetcher();
  now_ += milliseconds(1000);
  Announce(fetcher, 2);
  const auto heard = now_;
  now_ += milliseconds(4999);
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kFetching);
  now_ += milliseconds(1);
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kWaiting);
  EXPECT_EQ(fetcher.Progress(now_).waiting_since, heard);
}

TEST_F(RouteFetcherTest, SaysWhenTheSegmentsAreNotThoseOfTheManifest) {
  RouteFetcher fetcher = Fetcher();
  Deliver(fetcher, test::PieceOf(key_, 0, 100, 99));  // intact, but not what the scout taught
  Announce(fetcher, 1, RouteState::kComplete);
  EXPECT_FALSE(fetcher.Complete());
  EXPECT_EQ(fetcher.Progress(now_).state, FetchState::kWrong);
}

TEST_F(RouteFetcherTest, ACompleteRouteDoesNotChange) {
  RouteFetcher fetcher = Fetcher();
  Announce(fetcher, 2, RouteState::kComplete);
  Announce(fetcher, 3, RouteState::kComplete);
  Announce(fetcher, 1);
  EXPECT_EQ(fetcher.info()->segment_count, 2U);
  EXPECT_EQ(fetcher.Progress(now_).conflicting, 1U);
  Deliver(fetcher, pieces_[2]);
  EXPECT_EQ(fetcher.Progress(now_).conflicting, 2U);
}

}  // namespace
}  // namespace trailcast::exchange
