// Two keepers of one store, as two servers are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_keeper.h"
#include "tests/support/memory_store.h"
#include "tests/support/pieces.h"

namespace trailcast::exchange {
namespace {

using route::RouteState;
using std::chrono::milliseconds;
using test::Only;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::size_t kA = 0;
constexpr std::size_t kB = 1;

class SharedStoreTest : public testing::Test {
 protected:
  SharedStoreTest() {
    for (std::size_t which : {kA, kB}) {
      const auto plan = [this](const route::RouteEdit&) {
        ++plans_;
        return planned_;
      };
      keepers_[which] = RouteKeeper::Open(AgentId(fmt::format("server-{}", which)), store_,
                                          {.answer = {}, .plan = plan}, test::ToyIntegrity())
                            .value();
    }
  }
  route::RouteInfo Info(std::uint32_t count, RouteState state) {
    return test::InfoOf(key_, std::span(pieces_).first(count), state);
  }
  void Announce(std::size_t to, std::uint32_t count, RouteState state = RouteState::kTeaching) {
    keepers_[to]->Handle(RouteAnnouncement{AgentId("scout-1"), Info(count, state)}, now_);
  }
  void Deliver(std::size_t to, std::vector<route::SegmentPiece> pieces) {
    keepers_[to]->Handle(SegmentBatch{AgentId("scout-1"), std::move(pieces)}, now_);
  }
  std::vector<Message> TickAfter(std::size_t which, milliseconds passed) {
    now_ += passed;
    return keepers_[which]->Tick(now_);
  }
  void Complete(std::size_t which, std::uint32_t count) {
    Announce(which, count, RouteState::kComplete);
    Deliver(which, {pieces_.begin(), pieces_.begin() + count});
    (void)TickAfter(which, milliseconds(300));
  }

  const route::RouteKey key_ = test::KeyNumber(1);
  const std::vector<route::SegmentPiece> pieces_ = test::PiecesOf(key_, 10);
  test::MemoryStore store_;
  std::array<std::unique_ptr<RouteKeeper>, 2> keepers_;
  RouteKeeper::Time now_{};
  Result<std::vector<route::RouteInfo>> planned_;  // what the next edit changes
  int plans_ = 0;
};

TEST_F(SharedStoreTest, WhatTheOtherStoredIsReceiptedAndNotAskedFor) {
  Announce(kB, 3);
  Deliver(kA, {pieces_[0], pieces_[1]});
  (void)TickAfter(kA, milliseconds(0));
  const auto out = TickAfter(kB, milliseconds(1200));
  const auto requests = Only<SegmentRequest>(out);
  ASSERT_EQ(requests.size(), 1U);
  EXPECT_EQ(requests[0].lacking, test::Indices(2, 3));
  const auto receipts = Only<Receipt>(TickAfter(kB, milliseconds(0)));
  ASSERT_EQ(receipts.size(), 1U);
  EXPECT_EQ(receipts[0].durable_prefix, 2U);
}

TEST_F(SharedStoreTest, AFollowerIsSentWhatTheOtherStored) {
  Announce(kB, 1);
  Deliver(kB, {pieces_[0]});
  (void)TickAfter(kB, milliseconds(0));
  Complete(kA, 4);
  now_ += milliseconds(2000);
  keepers_[kB]->Handle(SegmentRequest{AgentId("follower-1"), key_, test::Indices(1, 4)}, now_);
  const auto out = TickAfter(kB, milliseconds(100));
  EXPECT_EQ(test::PiecesIn(out), (std::vector{pieces_[1], pieces_[2], pieces_[3]}));
  const auto announced = Only<RouteAnnouncement>(out);
  ASSERT_EQ(announced.size(), 1U);
  EXPECT_EQ(announced[0].info, store_.FindRoute(key_).value());
}

TEST_F(SharedStoreTest, TheOthersWordIsAnnouncedWhereItIsLater) {
  Complete(kA, 2);  // and active, an edition later than the scout's
  Announce(kB, 2, RouteState::kComplete);
  const auto announced = Only<RouteAnnouncement>(TickAfter(kB, milliseconds(300)));
  for (const RouteAnnouncement& each : announced) {
    EXPECT_EQ(each.info.standing, route::Standing::kActive);
  }
  EXPECT_EQ(store_.FindRoute(key_).value()->edition, 1U);
}

TEST_F(SharedStoreTest, AnEditThatBothHearIsCarriedOutOnceAndAnsweredByBoth) {
  Complete(kA, 2);
  Complete(kB, 2);
  route::RouteInfo renamed = *store_.FindRoute(key_).value();
  renamed.name = "hall";
  ++renamed.edition;
  planned_ = {renamed};
  for (std::size_t which : {kA, kB}) {
    keepers_[which]->Handle(RouteEditRequest{AgentId("operator"), 7, {.route = "corridor"}}, now_);
    const auto out = TickAfter(which, milliseconds(0));
    ASSERT_EQ(Only<CatalogReply>(out).size(), 1U);
    EXPECT_EQ(Only<CatalogReply>(out)[0].page.routes, std::vector{renamed});
    ASSERT_EQ(Only<RouteAnnouncement>(out).size(), 1U);
    EXPECT_EQ(Only<RouteAnnouncement>(out)[0].info, renamed);
  }
  EXPECT_EQ(plans_, 1);
}

TEST_F(SharedStoreTest, ARefusedEditIsRefusedByBothEvenIfItWouldDoByNow) {
  planned_ = Fail(ErrorCode::kConflict, "it is not complete");
  for (std::size_t which : {kA, kB}) {
    keepers_[which]->Handle(RouteEditRequest{AgentId("operator"), 7, {.route = "corridor"}}, now_);
    const auto replies = Only<CatalogReply>(TickAfter(which, milliseconds(0)));
    ASSERT_EQ(replies.size(), 1U);
    EXPECT_EQ(replies[0].error, "it is not complete");
    planned_ = std::vector<route::RouteInfo>{};
  }
}

TEST_F(SharedStoreTest, WhatTheOtherDeletedIsTakenFromNobody) {
  Announce(kB, 3);
  Deliver(kB, {pieces_[0]});
  (void)TickAfter(kB, milliseconds(0));
  route::RouteInfo tombstone = *store_.FindRoute(key_).value();
  tombstone.standing = route::Standing::kDeleted;
  ++tombstone.edition;
  ASSERT_TRUE(store_.PutRoute(tombstone));
  now_ += milliseconds(2000);
  Deliver(kB, {pieces_[1]});
  const auto receipts = Only<Receipt>(TickAfter(kB, milliseconds(0)));
  ASSERT_EQ(receipts.size(), 1U);
  EXPECT_EQ(receipts[0].refusal, Refusal::kDeleted);
  EXPECT_THAT(store_.HeldSegments(key_).value(), IsEmpty());
}

class TwoServersTest : public SharedStoreTest {
 protected:
  TwoServersTest() {
    Complete(kA, 10);
    EXPECT_TRUE(follower_->Listen(Topic::kSegments, {key_}));
    for (const std::size_t which : {kA, kB}) {
      ends_[which] = bus_.Open(ServerTopics());
      AgentStatus status{.agent = AgentId(fmt::format("server-{}", which)), .instance = which + 1};
      status.role = AgentRole::kServer;
      status.mode = AgentMode::kWaiting;
      EXPECT_TRUE(ends_[which]->Publish(status));
    }
    Turn();
  }
  // One turn of the loop of each that runs.
  void Turn() {
    now_ += milliseconds(20);
    for (const std::size_t which : {kA, kB}) {
      if (!ends_[which]) continue;
      for (const Message& message : ends_[which]->Take(milliseconds(0))) {
        keepers_[which]->Handle(message, now_);
      }
      (void)PublishAll(*ends_[which], keepers_[which]->Tick(now_));
    }
  }
  // Returns the segments that the follower is sent within a while, out of those that it asks for,
  // sorted.
  std::vector<std::uint32_t> SentTo(const std::string& follower,
                                    const std::vector<SegmentIndex>& ask, milliseconds within) {
    EXPECT_TRUE(follower_->Publish(SegmentRequest{AgentId(follower), key_, ask}));
    std::vector<std::uint32_t> sent;
    for (milliseconds passed{0}; passed < within; passed += milliseconds(20)) {
      Turn();
      for (const auto& piece : test::PiecesIn(follower_->Take(milliseconds(0)))) {
        sent.push_back(piece.index.value());
      }
    }
    std::sort(sent.begin(), sent.end());
    return sent;
  }

  InProcessBus bus_;
  std::array<std::unique_ptr<RouteExchange>, 2> ends_;
  std::unique_ptr<RouteExchange> follower_ = bus_.Open(FollowerTopics());
};

TEST_F(TwoServersTest, EachSegmentIsSentOnce) {
  EXPECT_THAT(SentTo("robot-1", test::Indices(0, 5), milliseconds(2000)),
              ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(SentTo("robot-2", test::Indices(3, 8), milliseconds(2000)),
              ElementsAre(3, 4, 5, 6, 7));
}

TEST_F(TwoServersTest, WhenEitherStopsWithoutAWordTheOtherSendsAll) {
  for (const std::size_t stopped : {kA, kB}) {
    std::unique_ptr<RouteExchange> end = std::move(ends_[stopped]);
    EXPECT_THAT(SentTo(fmt::format("robot-{}", stopped), test::Indices(0, 5), milliseconds(900)),
                ElementsAre(0, 1, 2, 3, 4))
        << stopped << " is stopped";
    ends_[stopped] = std::move(end);
    (void)ends_[stopped]->Take(milliseconds(0));
  }
}

}  // namespace
}  // namespace trailcast::exchange
