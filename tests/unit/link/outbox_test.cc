#include "agent/link/outbox.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "services/route/digest.h"
#include "tests/support/pieces.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {

// The segment's bytes in the store's file are no longer what they were.
void DamageSegment(const std::filesystem::path& file, int number) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
  const std::string sql =
      fmt::format("UPDATE segment SET bytes = zeroblob(length(bytes)) WHERE number = {}", number);
  EXPECT_EQ(sqlite3_exec(db, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(db);
}

}  // namespace trailcast::test

namespace trailcast::agent {
namespace {

using route::RouteState;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const AgentId kScout("scout");
const route::RouteKey kKey{RouteId(std::string(32, '1')), TeachingId(1)};

route::Segment SegmentNumber(std::uint32_t index) {
  route::Segment segment;
  segment.index = SegmentIndex(index);
  segment.has_odometry = true;
  segment.length_m = 2.0;
  segment.duration_s = 4.0;
  route::Feature feature;
  feature.track = {{0.0F, 1.0F, 2.0F}, {1.0F, 3.0F, 4.0F}};
  segment.features.push_back(feature);
  return segment;
}

class OutboxTest : public testing::Test {
 protected:
  OutboxTest() { Restart(); }
  // Restarts as after a crash, with nothing but the file left.
  void Restart() {
    outbox_.reset();
    store_.reset();
    store_ = *store::OpenSqliteStore(folder_ / "scout.db");
    outbox_.emplace(kScout, *store_);
  }
  void Teach(std::uint32_t segments) {
    route::RouteInfo info;
    info.key = kKey;
    info.name = "hall";
    info.scout = kScout;
    info.image_width_px = 320;
    info.image_height_px = 240;
    ASSERT_TRUE(outbox_->Begin(info));
    for (std::uint32_t i = 0; i < segments; ++i) ASSERT_TRUE(outbox_->Add(kKey, SegmentNumber(i)));
  }
  void Confirm(std::uint32_t prefix, RouteState state) {
    std::vector<route::SegmentPiece> pieces;
    for (std::uint32_t i = 0; i < prefix; ++i) {
      pieces.push_back(route::MakePiece(kKey, SegmentNumber(i)));
    }
    outbox_->Handle(test::ReceiptFor(AgentId("server"), kKey, pieces, prefix, {}, state), {});
    ASSERT_TRUE(outbox_->SaveReceipts());
  }
  route::RouteInfo Stored() { return **store_->FindRoute(kKey); }

  test::TempDir folder_;
  std::unique_ptr<store::RouteStore> store_;
  std::optional<Outbox> outbox_;
};

TEST_F(OutboxTest, HasASegmentOnDiskBeforeItIsSent) {
  Teach(2);
  EXPECT_THAT(*store_->HeldSegments(kKey), SizeIs(2));
  EXPECT_EQ(Stored().segment_count, 2U);
  EXPECT_EQ(Stored().state, RouteState::kTeaching);
  std::size_t sent = 0;
  for (const auto& message : outbox_->Tick({})) {
    const auto* batch = std::get_if<exchange::SegmentBatch>(&message);
    if (batch != nullptr) sent += batch->pieces.size();
  }
  EXPECT_EQ(sent, 2U);
}

TEST_F(OutboxTest, WhatABlockedLinkDidNotTakeIsSentLater) {
  Teach(2);
  exchange::RouteSender::Time now{};
  for (const auto& message : outbox_->Tick(now)) outbox_->NotSent(message, now);
  now += std::chrono::milliseconds(100);
  const auto again = outbox_->Tick(now);
  EXPECT_THAT(test::PiecesIn(again), SizeIs(2));
  EXPECT_THAT(test::Only<exchange::RouteAnnouncement>(again), SizeIs(1));
}

TEST_F(OutboxTest, IsEmptyOnceAServerHasEverything) {
  Teach(3);
  ASSERT_TRUE(outbox_->Complete(kKey));
  EXPECT_EQ(outbox_->unreceipted(), 3U);
  Confirm(3, RouteState::kComplete);
  EXPECT_EQ(outbox_->unreceipted(), 0U);
  EXPECT_TRUE(outbox_->AllReceipted());
  Restart();
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty());
}

TEST_F(OutboxTest, TakesUpWhatAnEarlierRunCouldNotDeliver) {
  Teach(3);
  ASSERT_TRUE(outbox_->Complete(kKey));
  Confirm(1, RouteState::kTeaching);
  Restart();
  const auto notes = outbox_->LoadBacklog();
  ASSERT_TRUE(notes) << notes.error().message;
  EXPECT_THAT(*notes, ElementsAre(HasSubstr("2 of 3 segments are not acknowledged")));
  EXPECT_EQ(outbox_->unreceipted(), 2U);
}

TEST_F(OutboxTest, EndsARouteWhoseTeachingWasCutOff) {
  Teach(3);
  Restart();
  const auto notes = outbox_->LoadBacklog();
  ASSERT_TRUE(notes) << notes.error().message;
  EXPECT_THAT(*notes, ElementsAre(HasSubstr("cut off")));
  const route::RouteInfo info = Stored();
  EXPECT_EQ(info.state, RouteState::kComplete);
  EXPECT_EQ(info.segment_count, 3U);
  EXPECT_DOUBLE_EQ(info.length_m, 6.0);
  std::vector<route::Digest> digests;
  for (std::uint32_t i = 0; i < 3; ++i) {
    digests.push_back(store_->ReadSegment(kKey, SegmentIndex(i))->digest);
  }
  EXPECT_EQ(info.manifest_digest, route::ManifestDigest(digests));
}

TEST_F(OutboxTest, ComesBackToARouteOfWhichOnlyTheEndIsUnconfirmed) {
  Teach(2);
  ASSERT_TRUE(outbox_->Complete(kKey));
  Confirm(2, RouteState::kTeaching);  // all segments, but not that they are all
  EXPECT_FALSE(outbox_->AllReceipted());
  Restart();
  EXPECT_THAT(*outbox_->LoadBacklog(), SizeIs(1));
  Confirm(2, RouteState::kComplete);
  EXPECT_TRUE(outbox_->AllReceipted());
  Restart();
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty());
}

TEST_F(OutboxTest, LeavesAnotherAgentsUnfinishedRouteAlone) {
  Teach(2);
  outbox_.emplace(AgentId("scout2"), *store_);
  EXPECT_THAT(*outbox_->LoadBacklog(), ElementsAre(HasSubstr("--name scout")));
  EXPECT_EQ(outbox_->unreceipted(), 0U);
  EXPECT_EQ(Stored().state, RouteState::kTeaching);
}

TEST_F(OutboxTest, ARouteWhoseTeachingWasCutOffSaysSo) {
  Teach(3);
  Restart();
  ASSERT_TRUE(outbox_->LoadBacklog());
  EXPECT_TRUE(Stored().cut_off);
}

TEST_F(OutboxTest, ADamagedSegmentIsThatSegmentsTroubleAlone) {
  Teach(3);
  store_.reset();
  test::DamageSegment(folder_ / "scout.db", 1);
  Restart();
  const auto notes = outbox_->LoadBacklog();
  ASSERT_TRUE(notes) << notes.error().message;
  EXPECT_EQ(Stored().segment_count, 3U);
  EXPECT_DOUBLE_EQ(Stored().length_m, 6.0) << "as long as the others";
  outbox_->Handle(exchange::SegmentRequest{AgentId("server"), kKey, test::Indices(0, 3)}, {});
  const auto sent = test::PiecesIn(outbox_->Tick(Outbox::Time{} + std::chrono::seconds(1)));
  ASSERT_THAT(sent, SizeIs(2));
  EXPECT_EQ(sent[1].index, SegmentIndex(2));
  EXPECT_THAT(outbox_->TakeReadErrors(), SizeIs(1));
}

TEST_F(OutboxTest, OffersAgainWhatAServerOnceHadAndLacks) {
  Teach(2);
  ASSERT_TRUE(outbox_->Complete(kKey));
  Confirm(2, RouteState::kComplete);
  Restart();
  ASSERT_THAT(*outbox_->LoadBacklog(), IsEmpty());
  const exchange::SegmentRequest who_has{AgentId("server"), kKey, {}};
  outbox_->Handle(who_has, {});
  EXPECT_THAT(outbox_->Tick({}), IsEmpty()) << "not known to be a server";
  exchange::AgentStatus server{.agent = AgentId("server")};
  server.role = exchange::AgentRole::kServer;
  outbox_->Handle(server, {});
  outbox_->Handle(who_has, {});
  const auto told = test::Only<exchange::RouteAnnouncement>(outbox_->Tick({}));
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_EQ(told[0].info, Stored());
  EXPECT_EQ(outbox_->unreceipted(), 2U);
  Confirm(2, RouteState::kComplete);
  EXPECT_TRUE(outbox_->AllReceipted());
}

TEST_F(OutboxTest, WhatAnOperatorDeletedStaysAndIsOfferedNoMore) {
  Teach(2);
  ASSERT_TRUE(outbox_->Complete(kKey));
  exchange::Receipt refusal{.server = AgentId("server"), .key = kKey};
  refusal.refusal = exchange::Refusal::kDeleted;
  refusal.reason = "an operator deleted it";
  outbox_->Handle(refusal, {});
  ASSERT_TRUE(outbox_->SaveReceipts());
  EXPECT_TRUE(outbox_->Done());
  EXPECT_FALSE(outbox_->AllReceipted());
  EXPECT_THAT(*outbox_->refusal(), HasSubstr("an operator deleted it"));
  EXPECT_THAT(*store_->HeldSegments(kKey), SizeIs(2));
  Restart();
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty());
}

TEST_F(OutboxTest, GoesOnWithTheSameTeachingWhileItsEndWasNotTold) {
  Teach(3);
  Confirm(2, RouteState::kTeaching);
  Restart();
  const route::RouteInfo cut_off = Stored();
  outbox_->Spare(kKey);
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty()) << "its end is not told";
  ASSERT_TRUE(outbox_->GoOn(cut_off, cut_off));
  EXPECT_EQ(outbox_->unreceipted(), 1U);
  ASSERT_TRUE(outbox_->Add(kKey, SegmentNumber(3)));
  ASSERT_TRUE(outbox_->Complete(kKey));
  const route::RouteInfo whole = Stored();
  EXPECT_EQ(whole.state, RouteState::kComplete);
  EXPECT_FALSE(whole.cut_off);
  EXPECT_EQ(whole.segment_count, 4U);
  EXPECT_DOUBLE_EQ(whole.length_m, 8.0);
  Confirm(4, RouteState::kComplete);
  EXPECT_TRUE(outbox_->AllReceipted());
}

TEST_F(OutboxTest, GoesOnWithWhatWasToldToEndThereAsAnotherTeaching) {
  Teach(3);
  ASSERT_TRUE(outbox_->Complete(kKey, /*cut_off=*/true));
  Restart();
  route::RouteInfo on = Stored();
  on.key.teaching = TeachingId(2);
  on.revision = RevisionNumber(2);
  ASSERT_TRUE(outbox_->GoOn(Stored(), on));
  ASSERT_TRUE(outbox_->Add(on.key, SegmentNumber(3)));
  ASSERT_TRUE(outbox_->Complete(on.key));
  const route::RouteInfo whole = **store_->FindRoute(on.key);
  EXPECT_FALSE(whole.cut_off);
  EXPECT_EQ(whole.segment_count, 4U);
  EXPECT_EQ(store_->ReadSegment(on.key, SegmentIndex(1))->digest,
            store_->ReadSegment(kKey, SegmentIndex(1))->digest);
  EXPECT_TRUE(Stored().cut_off) << "as it was";
}

TEST_F(OutboxTest, DoesNotGoOnWithATeachingOfWhichASegmentIsDamaged) {
  Teach(3);
  store_.reset();
  test::DamageSegment(folder_ / "scout.db", 1);
  Restart();
  const route::RouteInfo cut_off = Stored();
  const auto goes_on = outbox_->GoOn(cut_off, cut_off);
  ASSERT_FALSE(goes_on);
  EXPECT_EQ(goes_on.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(goes_on.error().message, HasSubstr("cannot go on with route 'hall'"));
}

TEST_F(OutboxTest, WhatNoServerHasIsNotSentOnceItIsDiscarded) {
  Teach(2);
  Restart();
  EXPECT_THAT(*outbox_->Discard(Stored(), /*send=*/true), HasSubstr("no server has confirmed"));
  EXPECT_EQ(Stored().standing, route::Standing::kRetired);
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty());
  EXPECT_THAT(outbox_->Tick({}), IsEmpty());
  EXPECT_TRUE(outbox_->Done());
}

TEST_F(OutboxTest, OfWhatIsDiscardedAServerIsToldThatItWasCutOffAndItIsOfferedNoMore) {
  Teach(3);
  Confirm(1, RouteState::kTeaching);
  Restart();
  EXPECT_THAT(*outbox_->Discard(Stored(), /*send=*/true),
              HasSubstr("'trailcast routes delete 1111111'"));
  const auto told = test::Only<exchange::RouteAnnouncement>(outbox_->Tick({}));
  ASSERT_THAT(told, SizeIs(1));
  EXPECT_TRUE(told[0].info.cut_off);
  EXPECT_EQ(told[0].info.standing, route::Standing::kStaged) << "labels are the operator's";
  EXPECT_EQ(Stored().standing, route::Standing::kRetired);
  Confirm(3, RouteState::kComplete);
  EXPECT_TRUE(outbox_->AllReceipted());
  EXPECT_EQ(Stored().standing, route::Standing::kRetired);
  Restart();
  EXPECT_THAT(*outbox_->LoadBacklog(), IsEmpty());
}

}  // namespace
}  // namespace trailcast::agent
