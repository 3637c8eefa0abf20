#include "services/exchange/route_sender.h"

#include <gtest/gtest.h>

#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteState;
using std::chrono::milliseconds;
using test::Indices;
using test::Only;

class RouteSenderTest : public testing::Test {
 protected:
  RouteSender Sender(const std::vector<SegmentIndex>& receipted = {}) {
    std::vector<route::Digest> digests;
    for (const route::SegmentPiece& piece : pieces_) digests.push_back(piece.digest);
    const auto read = [this](SegmentIndex index) -> Result<route::SegmentPiece> {
      return pieces_.at(index.value());
    };
    return {AgentId("scout-1"), Info(RouteState::kTeaching), read, SegmentDigests(digests),
            receipted};
  }
  void Teach(RouteSender& sender) {
    pieces_.push_back(test::PieceOf(key_, static_cast<std::uint32_t>(pieces_.size())));
    sender.Add(pieces_.back(), Info(RouteState::kTeaching));
  }
  route::RouteInfo Info(RouteState state) { return test::InfoOf(key_, pieces_, state); }
  void Ask(RouteSender& sender, const std::string& who, std::vector<SegmentIndex> lacking) {
    sender.Handle(SegmentRequest{AgentId(who), key_, std::move(lacking)}, now_);
  }
  Receipt ReceiptOf(std::uint32_t prefix, const std::vector<SegmentIndex>& beyond = {},
                    RouteState state = RouteState::kTeaching) {
    return test::ReceiptFor(AgentId("server-1"), key_, pieces_, prefix, beyond, state);
  }
  void Confirm(RouteSender& sender, std::uint32_t prefix,
               const std::vector<SegmentIndex>& beyond = {},
               RouteState state = RouteState::kTeaching) {
    sender.Handle(ReceiptOf(prefix, beyond, state), now_);
  }
  std::vector<Message> TickAfter(RouteSender& sender, milliseconds passed) {
    now_ += passed;
    return sender.Tick(now_);
  }

  const route::RouteKey key_ = test::KeyNumber(1);
  std::vector<route::SegmentPiece> pieces_;
  RouteSender::Time now_{};
};

TEST_F(RouteSenderTest, StreamsASegmentOnceBeforeTheAnnouncementThatCountsIt) {
  RouteSender sender = Sender();
  (void)sender.Tick(now_);
  Teach(sender);
  const std::vector<Message> sent = sender.Tick(now_);
  EXPECT_EQ(sent, (std::vector<Message>{
                      SegmentBatch{AgentId("scout-1"), pieces_},
                      RouteAnnouncement{AgentId("scout-1"), Info(RouteState::kTeaching)}}));
  EXPECT_TRUE(TickAfter(sender, milliseconds(100)).empty());
}

TEST_F(RouteSenderTest, WhatABlockedLinkDidNotTakeIsSentLater) {
  RouteSender sender = Sender();
  (void)sender.Tick(now_);
  Teach(sender);
  pieces_.push_back(test::PieceOf(key_, 1));
  route::SegmentPiece taught_before = pieces_.back();
  taught_before.bytes.clear();
  sender.Add(taught_before, Info(RouteState::kTeaching));
  const std::vector<Message> sent = sender.Tick(now_);
  ASSERT_EQ(test::PiecesIn(sent), (std::vector{pieces_[0], taught_before}));
  for (const Message& message : sent) sender.NotSent(message, now_);
  const auto again = TickAfter(sender, milliseconds(100));
  EXPECT_EQ(test::PiecesIn(again), (std::vector{taught_before, pieces_[0]}));
  EXPECT_EQ(Only<RouteAnnouncement>(again).size(), 1U);
  EXPECT_TRUE(TickAfter(sender, milliseconds(100)).empty());
}

TEST_F(RouteSenderTest, AnnouncesAgainUntilEverythingIsReceipted) {
  RouteSender sender = Sender();
  Teach(sender);
  (void)sender.Tick(now_);
  EXPECT_TRUE(TickAfter(sender, milliseconds(1999)).empty());
  EXPECT_EQ(TickAfter(sender, milliseconds(1)).size(), 1U);
  sender.Update(Info(RouteState::kComplete));
  (void)sender.Tick(now_);
  Confirm(sender, 1);
  EXPECT_FALSE(sender.AllReceipted());  // the server may not know that the route is complete
  EXPECT_EQ(TickAfter(sender, milliseconds(2000)).size(), 1U);
  Confirm(sender, 1, {}, RouteState::kComplete);
  EXPECT_TRUE(sender.AllReceipted());
  EXPECT_TRUE(TickAfter(sender, milliseconds(5000)).empty());
}

TEST_F(RouteSenderTest, ReportsEachReceiptedSegmentOnce) {
  RouteSender sender = Sender();
  for (int i = 0; i < 5; ++i) Teach(sender);
  Confirm(sender, 2, {SegmentIndex(3), SegmentIndex(77)});
  EXPECT_EQ(sender.TakeNewlyReceipted(),
            (std::vector{SegmentIndex(0), SegmentIndex(1), SegmentIndex(3)}));
  Confirm(sender, 2, {SegmentIndex(3)});
  EXPECT_TRUE(sender.TakeNewlyReceipted().empty());
  EXPECT_EQ(sender.Unreceipted(), (std::set{SegmentIndex(2), SegmentIndex(4)}));
}

TEST_F(RouteSenderTest, ReceiptsOfOtherRoutesAndBeyondTheEndChangeNothing) {
  RouteSender sender = Sender();
  Teach(sender);
  Receipt other = ReceiptOf(1, {}, RouteState::kComplete);
  other.key = test::KeyNumber(2);
  sender.Handle(other, now_);
  EXPECT_EQ(sender.Unreceipted().size(), 1U);
  Receipt beyond = ReceiptOf(1);
  beyond.durable_prefix = 100'000;
  sender.Handle(beyond, now_);
  EXPECT_EQ(sender.Unreceipted().size(), 1U);
}

TEST_F(RouteSenderTest, AReceiptOfOtherBytesConfirmsNothing) {
  RouteSender sender = Sender();
  for (int i = 0; i < 4; ++i) Teach(sender);
  sender.Update(Info(RouteState::kComplete));
  std::vector<route::SegmentPiece> others = pieces_;
  others[0] = test::PieceOf(key_, 0, 100, 1);
  others[3] = test::PieceOf(key_, 3, 100, 1);
  const AgentId server("server-1");
  sender.Handle(test::ReceiptFor(server, key_, others, 4, {}, RouteState::kComplete), now_);
  EXPECT_EQ(sender.Unreceipted().size(), 4U);
  EXPECT_FALSE(sender.AllReceipted());
  EXPECT_EQ(sender.contradicted_by(), server);
  sender.Handle(test::ReceiptFor(server, key_, others, 0, {SegmentIndex(2), SegmentIndex(3)}),
                now_);
  EXPECT_EQ(sender.TakeNewlyReceipted(), std::vector{SegmentIndex(2)});
  Confirm(sender, 4, {}, RouteState::kComplete);
  EXPECT_TRUE(sender.AllReceipted());
  EXPECT_FALSE(sender.contradicted_by());
}

TEST_F(RouteSenderTest, TakesTheNumberThatTheServerGives) {
  RouteSender sender = Sender();
  Teach(sender);
  EXPECT_FALSE(sender.TakeNumbered());
  Receipt receipt = ReceiptOf(1);
  receipt.revision = RevisionNumber(3);
  sender.Handle(receipt, now_);
  EXPECT_EQ(sender.TakeNumbered()->revision, RevisionNumber(3));
  EXPECT_FALSE(sender.TakeNumbered());
  Teach(sender);  // by whoever does not know it
  EXPECT_EQ(sender.info().revision, RevisionNumber(3));
}

TEST_F(RouteSenderTest, AnswersWhatOnlyItHas) {
  RouteSender sender = Sender();
  for (int i = 0; i < 3; ++i) Teach(sender);
  (void)sender.Tick(now_);
  Ask(sender, "server-1", {SegmentIndex(1), SegmentIndex(2), SegmentIndex(9)});
  EXPECT_TRUE(TickAfter(sender, milliseconds(9)).empty());
  const auto sent = test::PiecesIn(TickAfter(sender, milliseconds(1)));
  EXPECT_EQ(sent, (std::vector{pieces_[1], pieces_[2]}));
}

TEST_F(RouteSenderTest, LeavesWhatAServerHasToTheServerUnlessAskedAgain) {
  RouteSender sender = Sender();
  Teach(sender);
  (void)sender.Tick(now_);
  Confirm(sender, 1);
  Ask(sender, "follower-1", {SegmentIndex(0)});
  EXPECT_TRUE(TickAfter(sender, milliseconds(100)).empty());
  Ask(sender, "follower-2", {SegmentIndex(0)});
  EXPECT_TRUE(TickAfter(sender, milliseconds(100)).empty());
  Ask(sender, "follower-1", {SegmentIndex(0)});
  EXPECT_EQ(test::PiecesIn(TickAfter(sender, milliseconds(100))), pieces_);
}

TEST_F(RouteSenderTest, TellsDigestsAtOnceOfWhatOnlyItHas) {
  RouteSender sender = Sender();
  for (int i = 0; i < 2; ++i) Teach(sender);
  (void)sender.Tick(now_);
  sender.Handle(SegmentRequest{AgentId("follower-1"), key_, Indices(1, 9), true}, now_);
  route::SegmentPiece named = pieces_[1];
  named.bytes.clear();
  EXPECT_EQ(test::PiecesIn(sender.Tick(now_)), std::vector{named});
}

TEST_F(RouteSenderTest, AnnouncesToWhoAsksWhoHasTheRoute) {
  RouteSender sender = Sender();
  (void)sender.Tick(now_);
  Ask(sender, "follower-1", {});
  EXPECT_EQ(Only<RouteAnnouncement>(sender.Tick(now_)).size(), 1U);
}

TEST_F(RouteSenderTest, GoesOnAfterARestart) {
  pieces_ = test::PiecesOf(key_, 4);
  RouteSender sender = Sender(Indices(0, 2));
  EXPECT_EQ(sender.Unreceipted(), (std::set{SegmentIndex(2), SegmentIndex(3)}));
  EXPECT_EQ(sender.Tick(now_).size(), 1U);  // announces, streams nothing
  Ask(sender, "server-1", Indices(2, 4));
  EXPECT_EQ(test::PiecesIn(TickAfter(sender, milliseconds(50))).size(), 2U);
}

TEST_F(RouteSenderTest, GoesOnOfferingWhatAFullServerRefuses) {
  RouteSender sender = Sender();
  Teach(sender);
  (void)sender.Tick(now_);
  Receipt refusal = ReceiptOf(0);
  refusal.refusal = Refusal::kFull;
  refusal.reason = "disk full";
  sender.Handle(refusal, now_);
  ASSERT_TRUE(sender.refused());
  EXPECT_EQ(sender.refused()->reason, "disk full");
  EXPECT_EQ(sender.Unreceipted().size(), 1U);
  EXPECT_EQ(Only<RouteAnnouncement>(TickAfter(sender, milliseconds(2000))).size(), 1U);
  Confirm(sender, 1);
  EXPECT_FALSE(sender.refused());
}

TEST_F(RouteSenderTest, HearsWhatAServerSaysOfWhatItTook) {
  RouteSender sender = Sender();
  Teach(sender);
  EXPECT_EQ(sender.remark(), "");
  Receipt receipt = ReceiptOf(1);
  receipt.reason = "crosses hall at 12.3 m";
  sender.Handle(receipt, now_);
  EXPECT_FALSE(sender.refused());
  EXPECT_EQ(sender.remark(), "crosses hall at 12.3 m");
  EXPECT_TRUE(sender.Unreceipted().empty());
}

TEST_F(RouteSenderTest, StopsSendingWhatAnOperatorDeleted) {
  RouteSender sender = Sender();
  Teach(sender);
  Receipt refusal = ReceiptOf(0);
  refusal.refusal = Refusal::kDeleted;
  sender.Handle(refusal, now_);
  Teach(sender);
  EXPECT_TRUE(test::PiecesIn(sender.Tick(now_)).empty());
  sender.Update(Info(RouteState::kComplete));
  EXPECT_TRUE(sender.Done()) << "nobody waits for them";
  EXPECT_FALSE(sender.AllReceipted()) << "and nobody has them";
  EXPECT_TRUE(sender.TakeNewlyReceipted().empty());
}

}  // namespace
}  // namespace trailcast::exchange
