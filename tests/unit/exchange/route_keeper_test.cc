#include "services/exchange/route_keeper.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/memory_store.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteState;
using std::chrono::milliseconds;
using test::Indices;
using test::Only;

class RouteKeeperTest : public testing::Test {
 protected:
  RouteKeeperTest() { Restart(); }

  void Restart() {
    const auto catalog = [](const CatalogRequest& request) {
      return CatalogReply{.similar_names = {request.query.name + "-2"}};
    };
    const auto plan = [this](const route::RouteEdit&) { return planned_; };
    keeper_ = RouteKeeper::Open(AgentId("server-1"), store_, {.answer = catalog, .plan = plan},
                                test::ToyIntegrity())
                  .value();
  }
  route::RouteInfo Info(std::uint32_t count, RouteState state) {
    return test::InfoOf(key_, std::span(pieces_).first(count), state);
  }
  // Returns the route as the server has it once it is complete: a route's first revision is
  // activated.
  route::RouteInfo Active(std::uint32_t count) {
    route::RouteInfo info = Info(count, RouteState::kComplete);
    info.standing = route::Standing::kActive;
    info.edition = 1;
    return info;
  }
  // An operator's edit of `key_` by one who asks under this number; the answer.
  CatalogReply Edit(std::uint64_t request, const route::RouteInfo& to) {
    planned_ = {to};
    keeper_->Handle(RouteEditRequest{AgentId("operator"), request, {.route = "corridor"}}, now_);
    return Only<CatalogReply>(edited_ = Tick()).at(0);
  }
  void Announce(std::uint32_t count, RouteState state = RouteState::kTeaching) {
    keeper_->Handle(RouteAnnouncement{AgentId("scout-1"), Info(count, state)}, now_);
  }
  void Deliver(std::vector<route::SegmentPiece> pieces) {
    keeper_->Handle(SegmentBatch{AgentId("scout-1"), std::move(pieces)}, now_);
  }
  void Ask(const std::string& who, std::vector<SegmentIndex> lacking) {
    keeper_->Handle(SegmentRequest{AgentId(who), key_, std::move(lacking)}, now_);
  }
  std::vector<Message> TickAfter(milliseconds passed) {
    now_ += passed;
    return keeper_->Tick(now_);
  }
  std::vector<Message> Tick() { return TickAfter(milliseconds(0)); }

  const route::RouteKey key_ = test::KeyNumber(1);
  const std::vector<route::SegmentPiece> pieces_ = test::PiecesOf(key_, 10);
  test::MemoryStore store_;
  std::unique_ptr<RouteKeeper> keeper_;
  RouteKeeper::Time now_{};
  Result<std::vector<route::RouteInfo>> planned_;  // what the next edit changes
  std::vector<Message> edited_;                    // what the tick after it sent
};

TEST_F(RouteKeeperTest, StoresOneTakeInOneCommitThenReceipts) {
  Announce(4);
  Deliver({pieces_[0], pieces_[1]});
  Deliver({pieces_[3]});
  const auto out = Tick();
  EXPECT_EQ(store_.commits, 1);
  Receipt receipt = test::ReceiptFor(AgentId("server-1"), key_, pieces_, 2, {SegmentIndex(3)});
  receipt.revision = RevisionNumber(1);
  EXPECT_EQ(Only<Receipt>(out), std::vector{receipt});
  const auto announced = Only<RouteAnnouncement>(out);
  ASSERT_EQ(announced.size(), 1U);
  EXPECT_EQ(announced[0].info.segment_count, 2U);  // what can be served without a gap
  EXPECT_DOUBLE_EQ(announced[0].info.length_m, 4.0);
}

TEST_F(RouteKeeperTest, SaysCompleteOnlyWhenAllIsOnDiskAndTheManifestIsRight) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0]});
  EXPECT_EQ(Only<Receipt>(Tick()).at(0).durable_state, RouteState::kTeaching);
  Deliver({pieces_[1]});
  const auto out = TickAfter(milliseconds(300));
  EXPECT_EQ(Only<RouteAnnouncement>(out).at(0).info, Active(2));
  EXPECT_EQ(Only<Receipt>(out).at(0).durable_state, RouteState::kComplete);
  EXPECT_EQ(store_.FindRoute(key_).value(), Active(2));
}

TEST_F(RouteKeeperTest, WhatWasCutOffIsNotActivated) {
  route::RouteInfo cut_off = Info(2, RouteState::kComplete);
  cut_off.cut_off = true;
  keeper_->Handle(RouteAnnouncement{AgentId("scout-1"), cut_off}, now_);
  Deliver({pieces_[0], pieces_[1]});
  const Receipt receipt = Only<Receipt>(Tick()).at(0);
  EXPECT_EQ(receipt.durable_state, RouteState::kComplete);
  EXPECT_EQ(receipt.standing, route::Standing::kStaged);
  EXPECT_EQ(store_.FindRoute(key_).value(), cut_off);
}

// Its scout is told which revision robots follow in its stead.
TEST_F(RouteKeeperTest, WhatIsToBeReviewedIsNotActivatedAndTheNextRevisionIs) {
  route::RouteInfo waits = Info(2, RouteState::kComplete);
  waits.to_review = true;
  keeper_->Handle(RouteAnnouncement{AgentId("scout-1"), waits}, now_);
  Deliver({pieces_[0], pieces_[1]});
  const Receipt alone = Only<Receipt>(Tick()).at(0);
  EXPECT_EQ(alone.standing, route::Standing::kStaged);
  EXPECT_EQ(alone.followed, RevisionNumber());
  EXPECT_EQ(store_.FindRoute(key_).value(), waits);

  const route::RouteKey next = test::KeyNumber(1, 2);
  const auto pieces = test::PiecesOf(next, 2);
  Deliver(pieces);
  keeper_->Handle(
      RouteAnnouncement{AgentId("scout-1"), test::InfoOf(next, pieces, RouteState::kComplete)},
      now_);
  const Receipt second = Only<Receipt>(TickAfter(milliseconds(1000))).at(0);
  EXPECT_EQ(second.standing, route::Standing::kActive);
  EXPECT_EQ(second.followed, RevisionNumber(2));
  keeper_->Handle(RouteAnnouncement{AgentId("scout-1"), waits}, now_);
  const Receipt again = Only<Receipt>(TickAfter(milliseconds(1000))).at(0);
  EXPECT_EQ(again.standing, route::Standing::kStaged);
  EXPECT_EQ(again.followed, RevisionNumber(2));
}

TEST_F(RouteKeeperTest, AsksWhoHasWhatAgentsHoldAndItLacks) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  const route::RouteKey lost = test::KeyNumber(7);
  keeper_->Handle(AgentStatus{.agent = AgentId("robot"), .held = {key_, lost}}, now_);
  const auto asked = Only<SegmentRequest>(Tick());
  EXPECT_EQ(asked, (std::vector{SegmentRequest{AgentId("server-1"), lost, {}}}));
}

TEST_F(RouteKeeperTest, AsksWhoHasACompleteRouteThatItHasInPartOnly) {
  ASSERT_TRUE(store_.AppendSegments(std::vector{pieces_[0]}));
  ASSERT_TRUE(store_.PutRoute(Info(3, RouteState::kComplete)));
  keeper_ = RouteKeeper::Open(AgentId("server-1"), store_, {}, test::ToyIntegrity(),
                              {.announced_at_start = 0})
                .value();
  keeper_->Handle(AgentStatus{.agent = AgentId("robot"), .held = {key_}}, now_);
  const auto asked = Only<SegmentRequest>(Tick());
  EXPECT_EQ(asked, (std::vector{SegmentRequest{AgentId("server-1"), key_, {}}}));
}

TEST_F(RouteKeeperTest, ARouteIsNotCompletedWithFewerSegmentsThanItHas) {
  Announce(3);
  Deliver({pieces_[0], pieces_[1], pieces_[2]});
  (void)Tick();
  Announce(2, RouteState::kComplete);
  for (const Receipt& receipt : Only<Receipt>(TickAfter(milliseconds(1000)))) {
    EXPECT_EQ(receipt.durable_state, RouteState::kTeaching);
  }
  EXPECT_EQ(keeper_->counters().conflicting, 1U);
  EXPECT_EQ(store_.FindRoute(key_).value(), Info(3, RouteState::kTeaching));
  Announce(3, RouteState::kComplete);
  EXPECT_EQ(Only<Receipt>(TickAfter(milliseconds(1000))).at(0).durable_state,
            RouteState::kComplete);
}

TEST_F(RouteKeeperTest, NeverCompletesARouteOfWrongSegments) {
  Deliver({test::PieceOf(key_, 0, 100, 99)});
  Announce(1, RouteState::kComplete);
  const auto out = Tick();
  EXPECT_EQ(Only<Receipt>(out).at(0).durable_state, RouteState::kTeaching);
  EXPECT_TRUE(Only<RouteAnnouncement>(out).empty());
  const auto notes = keeper_->TakeNotes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_THAT(notes[0].text, testing::HasSubstr("manifest"));
}

TEST_F(RouteKeeperTest, AsksTheScoutForGapsAndAgainAfterARestart) {
  Announce(3);
  Deliver({pieces_[1]});
  (void)Tick();
  const auto asked = Only<SegmentRequest>(TickAfter(milliseconds(200)));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].lacking, (std::vector{SegmentIndex(0), SegmentIndex(2)}));
  Restart();
  Announce(3);
  EXPECT_EQ(Only<SegmentRequest>(TickAfter(milliseconds(200))), asked);
}

// After an outage an announcement may come before the segments that were written with it.
TEST_F(RouteKeeperTest, LeavesWhatARouteHasGrownByToTheWriterOfItForASecond) {
  Announce(1);
  Deliver({pieces_[0]});
  (void)Tick();
  Announce(4);
  Deliver({pieces_[1], pieces_[3]});
  EXPECT_TRUE(Only<SegmentRequest>(TickAfter(milliseconds(990))).empty());
  const auto asked = Only<SegmentRequest>(TickAfter(milliseconds(10)));
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].lacking, std::vector{SegmentIndex(2)});
}

TEST_F(RouteKeeperTest, AnnouncesAndReceiptsWhatItHoldsAfterARestart) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  Restart();
  const auto out = Tick();
  EXPECT_EQ(Only<RouteAnnouncement>(out).at(0).info, Active(2));
  EXPECT_EQ(Only<Receipt>(out).at(0).durable_prefix, 2U);
}

TEST_F(RouteKeeperTest, AnswersFollowersWhoAskTogetherOnce) {
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  Ask("follower-1", Indices(0, 5));
  Ask("follower-2", Indices(0, 2));
  EXPECT_TRUE(test::PiecesIn(TickAfter(milliseconds(9))).empty());
  const auto answers = TickAfter(milliseconds(1));
  EXPECT_EQ(test::PiecesIn(answers), (std::vector{pieces_[0], pieces_[1]}));
  EXPECT_TRUE(test::PiecesIn(TickAfter(milliseconds(100))).empty());
  EXPECT_EQ(keeper_->counters().answered, 0U) << "until they are handed over";
  for (const Message& message : answers) keeper_->Sent(message);
  EXPECT_EQ(keeper_->counters().answered, 2U);
  EXPECT_EQ(keeper_->counters().answered_bytes, pieces_[0].bytes.size() + pieces_[1].bytes.size());
}

TEST_F(RouteKeeperTest, AnswersThatALongStallBlockedAreSentAsSoonAsItIsOver) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  Ask("follower-1", Indices(0, 2));
  for (int tick = 0; tick < 100; ++tick) {  // 10 s; whoever asked has asked before that
    for (const Message& message : TickAfter(milliseconds(100))) keeper_->NotSent(message, now_);
  }
  Ask("follower-1", Indices(0, 2));
  const auto out = TickAfter(milliseconds(100));
  EXPECT_EQ(test::PiecesIn(out), (std::vector{pieces_[0], pieces_[1]}));
  for (const Message& message : out) keeper_->Sent(message);
  EXPECT_EQ(keeper_->counters().answered, 2U);
  EXPECT_TRUE(test::PiecesIn(TickAfter(milliseconds(100))).empty());
}

TEST_F(RouteKeeperTest, WhatElseCouldNotBeHandedOverIsSaidAgain) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  keeper_->Handle(CatalogRequest{AgentId("client"), 7, {.name = "x"}}, now_);
  const auto out = Tick();
  for (const Message& message : out) keeper_->NotSent(message, now_);
  const auto again = TickAfter(milliseconds(500));
  EXPECT_EQ(Only<RouteAnnouncement>(again), Only<RouteAnnouncement>(out));
  EXPECT_EQ(Only<Receipt>(again).size(), 1U);
  EXPECT_EQ(Only<CatalogReply>(again), Only<CatalogReply>(out));
}

TEST_F(RouteKeeperTest, RepeatsItsReceiptToAScoutThatMissedIt) {
  Announce(1);
  Deliver({pieces_[0]});
  EXPECT_EQ(Only<Receipt>(Tick()).size(), 1U);
  Announce(1);
  EXPECT_TRUE(Only<Receipt>(TickAfter(milliseconds(100))).empty());
  EXPECT_EQ(Only<Receipt>(TickAfter(milliseconds(400))).size(), 1U);
}

TEST_F(RouteKeeperTest, KeepsTheFirstOfTwoSegmentsThatContradictAndSaysSo) {
  const auto other = test::PieceOf(key_, 0, 100, 99);
  Deliver({pieces_[0]});
  (void)Tick();
  Restart();
  Deliver({other, pieces_[1]});
  (void)Tick();
  EXPECT_EQ(store_.ReadSegment(key_, SegmentIndex(0)).value(), pieces_[0]);
  EXPECT_EQ(store_.ReadSegment(key_, SegmentIndex(1)).value(), pieces_[1]);
  EXPECT_EQ(keeper_->counters().conflicting, 1U);
  EXPECT_EQ(keeper_->TakeNotes().at(0).severity, Note::Severity::kWarning);
}

TEST_F(RouteKeeperTest, OneDamagedPieceDoesNotCostTheOthers) {
  Announce(2);
  auto damaged = pieces_[0];
  damaged.bytes[0] ^= 1U;
  Deliver({damaged, pieces_[1]});
  const auto out = Tick();
  EXPECT_EQ(keeper_->counters().corrupt, 1U);
  EXPECT_EQ(Only<Receipt>(out).at(0).durable_beyond,
            (std::vector{NamedSegment{SegmentIndex(1), pieces_[1].digest}}));
}

TEST_F(RouteKeeperTest, AFullDiskMeansARefusalUntilThereIsRoom) {
  store_.full = true;
  Announce(1);
  Deliver({pieces_[0]});
  const auto refused = Only<Receipt>(Tick());
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].refusal, Refusal::kFull);
  EXPECT_EQ(refused[0].reason, "disk full");
  EXPECT_EQ(refused[0].durable_prefix, 0U);
  EXPECT_EQ(keeper_->TakeNotes().at(0).severity, Note::Severity::kError);
  EXPECT_EQ(keeper_->untaken(), "disk full");
  store_.full = false;
  EXPECT_EQ(Only<SegmentRequest>(TickAfter(milliseconds(200))).size(), 1U);
  Deliver({pieces_[0]});
  const auto taken = Only<Receipt>(Tick());
  ASSERT_EQ(taken.size(), 1U);
  EXPECT_EQ(taken[0].refusal, Refusal::kNone);
  EXPECT_EQ(taken[0].durable_prefix, 1U);
  EXPECT_EQ(keeper_->untaken(), "");
}

TEST_F(RouteKeeperTest, AScoutOverItsQuotaIsToldSoUntilAWhileAfter) {
  Announce(2);
  Deliver({pieces_[0]});
  keeper_->TellOverQuota(key_, "over quota: one a second", now_);
  Receipt receipt = Only<Receipt>(Tick()).at(0);
  EXPECT_EQ(receipt.refusal, Refusal::kFull);
  EXPECT_EQ(receipt.reason, "over quota: one a second");
  EXPECT_EQ(receipt.durable_prefix, 1U) << "what was taken is confirmed all the same";
  Deliver({pieces_[1]});
  EXPECT_EQ(Only<Receipt>(TickAfter(milliseconds(1000))).at(0).refusal, Refusal::kFull);
  receipt = Only<Receipt>(TickAfter(milliseconds(4000))).at(0);
  EXPECT_EQ(receipt.refusal, Refusal::kNone);
  EXPECT_EQ(receipt.durable_prefix, 2U);
}

TEST_F(RouteKeeperTest, AScoutReadsWhatIsWorthKnowingInItsReceipts) {
  Announce(2);
  Deliver({pieces_[0]});
  EXPECT_EQ(Only<Receipt>(Tick()).at(0).reason, "");
  keeper_->Remark(key_, "crosses hall at 12.3 m", now_);
  const Receipt receipt = Only<Receipt>(TickAfter(milliseconds(500))).at(0);
  EXPECT_EQ(receipt.refusal, Refusal::kNone);
  EXPECT_EQ(receipt.reason, "crosses hall at 12.3 m");
  keeper_->TellOverQuota(key_, "over quota", now_);
  EXPECT_EQ(Only<Receipt>(TickAfter(milliseconds(500))).at(0).reason, "over quota");
  keeper_->Remark({RouteId(std::string(32, 'f')), TeachingId(7)}, "of no stored route", now_);
  EXPECT_TRUE(Only<Receipt>(TickAfter(milliseconds(500))).empty());
}

TEST_F(RouteKeeperTest, ReportsTheSameTroubleNowAndThen) {
  store_.full = true;
  for (int i = 0; i < 100; ++i) {
    Deliver({pieces_[0]});
    (void)TickAfter(milliseconds(100));
  }
  EXPECT_EQ(keeper_->TakeNotes().size(), 1U);
  EXPECT_EQ(keeper_->counters().store_failures, 100U);
}

TEST_F(RouteKeeperTest, ACompleteRouteDoesNotChange) {
  Announce(1, RouteState::kComplete);
  Deliver({pieces_[0]});
  (void)Tick();
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[1]});
  (void)TickAfter(milliseconds(500));
  EXPECT_EQ(keeper_->counters().conflicting, 2U);
  EXPECT_EQ(store_.FindRoute(key_).value()->segment_count, 1U);
  EXPECT_EQ(store_.HeldSegments(key_).value().size(), 1U);
}

TEST_F(RouteKeeperTest, StoresWhatIsKnownOfSeveralRoutesInOneCommit) {
  for (unsigned i = 1; i <= 5; ++i) {
    const auto pieces = test::PiecesOf(test::KeyNumber(i), 1);
    keeper_->Handle(RouteAnnouncement{AgentId("scout-1"), test::InfoOf(test::KeyNumber(i), pieces,
                                                                       RouteState::kComplete)},
                    now_);
    Deliver(pieces);
  }
  EXPECT_EQ(Only<RouteAnnouncement>(Tick()).size(), 5U);
  EXPECT_EQ(store_.commits, 1);
  EXPECT_EQ(store_.route_commits, 1);
}

TEST_F(RouteKeeperTest, ARouteThatTheStoreRefusesDoesNotCostTheOthers) {
  const auto other = test::PiecesOf(test::KeyNumber(2), 1);
  keeper_ = RouteKeeper::Open(AgentId("server-1"), store_, {}, test::ToyIntegrity(),
                              {.announced_at_start = 0})
                .value();
  Announce(1, RouteState::kComplete);
  Deliver({pieces_[0]});
  keeper_->Handle(RouteAnnouncement{AgentId("scout-1"),
                                    test::InfoOf(test::KeyNumber(2), other, RouteState::kComplete)},
                  now_);
  Deliver(other);
  // Meanwhile another process's hand: the same route, complete, by another camera.
  route::RouteInfo taken = Info(1, RouteState::kComplete);
  taken.camera = "another";
  ASSERT_TRUE(store_.PutRoute(taken));
  const auto announced = Only<RouteAnnouncement>(Tick());
  ASSERT_EQ(announced.size(), 1U);
  EXPECT_EQ(announced[0].info.key, test::KeyNumber(2));
  EXPECT_EQ(keeper_->counters().conflicting, 1U);
}

TEST_F(RouteKeeperTest, AttendsToSoManyRoutesAtATimeAndLaysAsideWhatIsDone) {
  now_ += std::chrono::hours(1);
  keeper_ =
      RouteKeeper::Open(AgentId("server-1"), store_, {}, test::ToyIntegrity(), {.most_at_hand = 2})
          .value();
  for (unsigned i = 1; i <= 3; ++i) Deliver({test::PieceOf(test::KeyNumber(i), 0)});
  EXPECT_EQ(Only<Receipt>(Tick()).size(), 2U);
  EXPECT_THAT(keeper_->TakeNotes().at(0).text, testing::HasSubstr("the most"));
  now_ += std::chrono::seconds(11);
  for (unsigned i = 3; i <= 4; ++i) Deliver({test::PieceOf(test::KeyNumber(i), 0)});
  EXPECT_EQ(Only<Receipt>(Tick()).size(), 2U);
  for (unsigned i = 1; i <= 4; ++i) {
    EXPECT_EQ(store_.HeldSegments(test::KeyNumber(i)).value().size(), 1U) << i;
  }
}

TEST_F(RouteKeeperTest, AnswersForARouteThatItHadLaidAside) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  keeper_ = RouteKeeper::Open(AgentId("server-1"), store_, {}, test::ToyIntegrity(),
                              {.most_at_hand = 2, .announced_at_start = 0})
                .value();
  EXPECT_TRUE(Tick().empty());
  Ask("follower-1", Indices(0, 1));
  EXPECT_EQ(test::PiecesIn(TickAfter(milliseconds(50))), std::vector{pieces_[0]});
  Ask("follower-1", {});
  EXPECT_EQ(Only<RouteAnnouncement>(Tick()).at(0).info, Active(2));
}

TEST_F(RouteKeeperTest, AddressesCatalogReplies) {
  keeper_->Handle(CatalogRequest{AgentId("follower-1"), 7, {.name = "corridor"}}, now_);
  EXPECT_EQ(Only<CatalogReply>(Tick()),
            (std::vector{CatalogReply{.server = AgentId("server-1"),
                                      .client = AgentId("follower-1"),
                                      .request = 7,
                                      .similar_names = {"corridor-2"}}}));
}

TEST_F(RouteKeeperTest, OnlyARoutesFirstRevisionIsActivatedByItself) {
  for (const std::uint32_t revision : {1U, 2U}) {
    const auto pieces = test::PiecesOf(test::KeyNumber(1, revision), 1);
    Deliver(pieces);
    keeper_->Handle(
        RouteAnnouncement{AgentId("scout-1"), test::InfoOf(test::KeyNumber(1, revision), pieces,
                                                           RouteState::kComplete)},
        now_);
    (void)TickAfter(milliseconds(300));
  }
  EXPECT_EQ(store_.FindRoute(test::KeyNumber(1, 1)).value()->standing, route::Standing::kActive);
  EXPECT_EQ(store_.FindRoute(test::KeyNumber(1, 2)).value()->standing, route::Standing::kStaged);
}

TEST_F(RouteKeeperTest, AnEditIsDurableAnnouncedAndCarriedOutOnce) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  (void)Tick();
  route::RouteInfo renamed = Active(2);
  renamed.name = "hall";
  renamed.edition = 2;
  const CatalogReply first = Edit(7, renamed);
  EXPECT_EQ(first.page.routes, std::vector{renamed});
  EXPECT_EQ(store_.FindRoute(key_).value(), renamed);
  EXPECT_EQ(Only<RouteAnnouncement>(edited_).at(0).info, renamed);
  EXPECT_EQ(Edit(7, Active(2)), first) << "the answer was lost, and is given again";
  Announce(2, RouteState::kComplete);
  (void)TickAfter(milliseconds(300));
  EXPECT_EQ(store_.FindRoute(key_).value(), renamed) << "the scout knows nothing of the name";
}

TEST_F(RouteKeeperTest, AnEditThatCannotBeIsAnsweredWithTheReason) {
  planned_ = Fail(ErrorCode::kNotFound, "there is no route 'hall'");
  keeper_->Handle(RouteEditRequest{AgentId("operator"), 1, {.route = "hall"}}, now_);
  EXPECT_EQ(Only<CatalogReply>(Tick()).at(0).error, "there is no route 'hall'");
}

TEST_F(RouteKeeperTest, WhatIsDeletedStaysDeletedAndTheScoutIsTold) {
  Announce(3);
  Deliver({pieces_[0]});
  (void)Tick();
  route::RouteInfo tombstone = Info(1, RouteState::kTeaching);
  tombstone.standing = route::Standing::kDeleted;
  tombstone.edition = 1;
  (void)Edit(1, tombstone);
  EXPECT_EQ(Only<RouteAnnouncement>(edited_).at(0).info.standing, route::Standing::kDeleted);
  EXPECT_EQ(Only<Receipt>(edited_).at(0).refusal, Refusal::kDeleted);
  for (int start = 0; start < 2; ++start) {
    Announce(3, RouteState::kComplete);
    Deliver({pieces_[1], pieces_[2]});
    const auto out = TickAfter(std::chrono::seconds(1));
    EXPECT_EQ(Only<Receipt>(out).at(0).refusal, Refusal::kDeleted);
    EXPECT_EQ(Only<Receipt>(out).at(0).durable_prefix, 0U);
    EXPECT_TRUE(Only<SegmentRequest>(out).empty());
    EXPECT_TRUE(store_.HeldSegments(key_).value().empty());
    Restart();
  }
}

TEST_F(RouteKeeperTest, AnotherServersLaterEditionCounts) {
  Announce(1, RouteState::kComplete);
  Deliver({pieces_[0]});
  (void)Tick();
  route::RouteInfo retired = Info(1, RouteState::kComplete);
  retired.standing = route::Standing::kRetired;
  retired.edition = 5;
  keeper_->Handle(RouteAnnouncement{AgentId("server-2"), retired}, now_);
  (void)TickAfter(milliseconds(300));
  EXPECT_EQ(store_.FindRoute(key_).value(), retired);
}

TEST_F(RouteKeeperTest, WhatIsDamagedOnTheDiskIsAskedForAndMendedByAnyHolder) {
  Announce(3, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1], pieces_[2]});
  Tick();
  store_.damaged = {{key_, SegmentIndex(1)}};
  Restart();
  Tick();
  Ask("follower", Indices(0, 2));
  Tick();
  const auto out = TickAfter(milliseconds(50));  // the window for others' requests
  const auto sent = Only<SegmentBatch>(out);
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].pieces, std::vector{pieces_[0]});
  const auto asked = Only<SegmentRequest>(Tick());
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].lacking, Indices(1, 2));
  EXPECT_EQ(keeper_->counters().damaged, 1U);
  EXPECT_EQ(keeper_->TakeDamaged(), (std::vector{std::pair(key_, SegmentIndex(1))}));
  EXPECT_THAT(keeper_->TakeNotes().at(0).text, testing::HasSubstr("is damaged on the disk"));
  // Another's content for it is refused, whoever sends it.
  route::SegmentPiece forged = pieces_[2];
  forged.index = SegmentIndex(1);
  Deliver({forged});
  Tick();
  EXPECT_EQ(keeper_->counters().conflicting, 1U);
  EXPECT_EQ(keeper_->counters().repaired, 0U);
  Deliver({pieces_[1]});
  const auto receipts = Only<Receipt>(Tick());
  ASSERT_EQ(receipts.size(), 1U);
  EXPECT_EQ(receipts[0].durable_prefix, 3U);
  EXPECT_EQ(keeper_->counters().repaired, 1U);
  EXPECT_EQ(keeper_->TakeAppended(), std::vector{pieces_[1]});
  EXPECT_EQ(store_.ReadSegment(key_, SegmentIndex(1)).value(), pieces_[1]);
}

TEST_F(RouteKeeperTest, WhatARouteThatIsNotAtHandLacksIsAskedForOnceItIsAttendedTo) {
  ASSERT_TRUE(store_.AppendSegments(std::vector{pieces_[0]}));
  ASSERT_TRUE(store_.PutRoute(Info(3, RouteState::kComplete)));
  keeper_ = RouteKeeper::Open(AgentId("server-1"), store_, {}, test::ToyIntegrity(),
                              {.announced_at_start = 0})
                .value();
  EXPECT_TRUE(Tick().empty());
  keeper_->Attend(key_, now_);
  const auto asked = Only<SegmentRequest>(Tick());
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].lacking, Indices(1, 3));
}

TEST_F(RouteKeeperTest, SegmentsThatNobodyAnnouncedCanBeDroppedAndOthersCannot) {
  Deliver({pieces_[0], pieces_[1]});
  Tick();
  EXPECT_EQ(keeper_->DropOrphan(key_).value(), true);
  EXPECT_THAT(store_.HeldSegments(key_).value(), testing::IsEmpty());
  Announce(2);
  Deliver({pieces_[0]});
  const auto receipts = Only<Receipt>(Tick());
  ASSERT_EQ(receipts.size(), 1U);
  EXPECT_EQ(receipts[0].durable_prefix, 1U) << "what was dropped is not confirmed any more";
  EXPECT_EQ(keeper_->DropOrphan(key_).value(), false);
  EXPECT_EQ(store_.HeldSegments(key_).value().size(), 1U);
}

TEST_F(RouteKeeperTest, OfWhatIsLentOnlyWhatWasHereBeforeIsTaken) {
  Announce(3, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  Tick();
  store_.damaged = {{key_, SegmentIndex(1)}};
  keeper_->NoteDamage(key_, SegmentIndex(1), now_);
  const auto lend = [&](const route::SegmentPiece& piece) {
    keeper_->Handle(
        SegmentBatch{
            .sender = AgentId("follower"), .pieces = {piece}, .trust = SegmentBatch::Trust::kProof},
        now_);
    Tick();
  };
  (void)keeper_->TakeNotes();
  lend(pieces_[2]);  // nobody who knows said what it must be
  EXPECT_EQ(keeper_->counters().unproven, 1U);
  EXPECT_THAT(keeper_->TakeNotes().at(0).text, testing::HasSubstr("follower lends segment 2"));
  EXPECT_FALSE(store_.ReadSegment(key_, SegmentIndex(2)));
  lend(pieces_[1]);
  EXPECT_EQ(keeper_->counters().unproven, 1U);
  EXPECT_EQ(keeper_->counters().repaired, 1U);
}

TEST_F(RouteKeeperTest, AScoutIsBelievedWhatItTaughtItself) {
  const auto deliver = [&](const std::string& scout, const route::SegmentPiece& piece) {
    keeper_->Handle(
        SegmentBatch{
            .sender = AgentId(scout), .pieces = {piece}, .trust = SegmentBatch::Trust::kOwnRoutes},
        now_);
    Tick();
  };
  deliver("scout-1", pieces_[0]);  // before it is known whose the route is
  Announce(3, RouteState::kTeaching);
  deliver("scout-2", pieces_[1]);
  EXPECT_EQ(keeper_->counters().unproven, 1U);
  deliver("scout-1", pieces_[1]);
  EXPECT_EQ(keeper_->counters().unproven, 1U);
  EXPECT_TRUE(store_.ReadSegment(key_, SegmentIndex(1)));
}

TEST_F(RouteKeeperTest, ADigestAloneIsEnoughOfWhatAnotherRevisionHas) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  Tick();
  const route::RouteKey again{key_.route, TeachingId(2)};
  route::SegmentPiece known = pieces_[0];
  route::SegmentPiece fresh = pieces_[2];
  known.key = fresh.key = again;
  fresh.index = SegmentIndex(1);
  route::SegmentPiece named = known;
  named.bytes.clear();
  Deliver({named});
  keeper_->Handle(
      RouteAnnouncement{AgentId("scout-1"),
                        test::InfoOf(again, std::vector{known, fresh}, RouteState::kComplete)},
      now_);
  Tick();
  EXPECT_EQ(store_.ReadSegment(again, SegmentIndex(0)).value(), known);
  // It has only the name of the other one, and asks for it at once.
  EXPECT_TRUE(Only<SegmentRequest>(TickAfter(milliseconds(200))).size() == 1U);
  route::SegmentPiece name_alone = fresh;
  name_alone.bytes.clear();
  Deliver({name_alone});
  const auto asked = Only<SegmentRequest>(Tick());
  ASSERT_EQ(asked.size(), 1U);
  EXPECT_EQ(asked[0].key, again);
  EXPECT_EQ(asked[0].lacking, Indices(1, 2));
  Deliver({fresh});
  EXPECT_EQ(Only<Receipt>(TickAfter(milliseconds(600))).at(0).durable_state, RouteState::kComplete);
}

TEST_F(RouteKeeperTest, TellsDigestsAloneToWhoAsksForNoMore) {
  Announce(2, RouteState::kComplete);
  Deliver({pieces_[0], pieces_[1]});
  Tick();
  keeper_->Handle(SegmentRequest{AgentId("follower"), key_, Indices(0, 5), true}, now_);
  const auto told = Only<SegmentBatch>(Tick());
  ASSERT_EQ(told.size(), 1U);
  ASSERT_EQ(told[0].pieces.size(), 2U);
  EXPECT_TRUE(told[0].pieces[1].bytes.empty());
  EXPECT_EQ(told[0].pieces[1].digest, pieces_[1].digest);
}

TEST_F(RouteKeeperTest, AFloodOfRequestsForDigestsIsAnsweredInPart) {
  Deliver({pieces_[0]});
  (void)Tick();
  for (int i = 0; i < 10'000; ++i) {
    keeper_->Handle(SegmentRequest{AgentId("flood"), key_, Indices(0, 1), true}, now_);
  }
  EXPECT_EQ(Only<SegmentBatch>(Tick()).size(), 256U);
  keeper_->Handle(SegmentRequest{AgentId("robot"), key_, Indices(0, 1), true}, now_);
  EXPECT_EQ(Only<SegmentBatch>(Tick()).size(), 1U);
}

}  // namespace
}  // namespace trailcast::exchange
