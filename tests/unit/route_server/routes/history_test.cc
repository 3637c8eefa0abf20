#include "route_server/routes/history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/exchange/bounds.h"
#include "tests/support/memory_store.h"
#include "tests/support/temp_dir.h"

namespace trailcast::server {
namespace {

using network::Change;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

constexpr std::int64_t kBegin = 10'000;

class HistoryTest : public testing::Test {
 protected:
  void SetUp() override { Restart(kBegin); }
  void Restart(std::int64_t now) {
    history_.reset();
    auto store = store::HistoryStore::Open(folder_ / "history");
    ASSERT_TRUE(store) << store.error().message;
    auto history = History::Open(AgentId("server"), std::move(*store), routes_, now);
    ASSERT_TRUE(history) << history.error().message;
    history_ = std::move(*history);
  }
  // A complete revision, stored then by the server's clock.
  route::RouteInfo Store(std::uint64_t teaching, std::int64_t at_unix_ms) {
    const route::RouteKey key = test::KeyNumber(1, teaching);
    route::RouteInfo info = test::InfoOf(key, test::PiecesOf(key, 2), route::RouteState::kComplete);
    info.name = "hall";
    info.scout = AgentId("scout");
    info.length_m = 12.34;
    info.revision = RevisionNumber(static_cast<std::uint32_t>(teaching));
    EXPECT_TRUE(routes_.PutRoute(info));
    routes_.grown_unix_ms[key] = at_unix_ms;
    return info;
  }
  void Note(const std::vector<route::RouteInfo>& infos, const std::string& by, std::int64_t now) {
    const auto noted = history_->Note(infos, by, now);
    EXPECT_TRUE(noted) << noted.error().message;
  }
  network::History Told(std::int64_t since = 0) {
    std::vector<std::string> lines;
    exchange::NetworkRequest request{.client = AgentId("desk"), .request = 7};
    do {
      const auto reply = history_->Answer(request, since, 99'999);
      EXPECT_EQ(reply.error, "");
      EXPECT_TRUE(exchange::CheckBounds(reply));
      lines.insert(lines.end(), reply.lines.begin(), reply.lines.end());
      request.first = reply.next;
    } while (request.first != 0);
    return network::ParseHistory(lines);
  }

  test::TempDir folder_;
  test::MemoryStore routes_;
  std::unique_ptr<History> history_;
};

TEST_F(HistoryTest, ARevisionIsToldOnceWhenItWasStoredByTheServersClock) {
  auto info = Store(1, 11'000);
  info.standing = route::Standing::kActive;
  Note({info}, "", 12'000);
  Note({info}, "", 13'000);
  Restart(14'000);
  Note({info}, "", 15'000);
  EXPECT_THAT(Told().changes,
              ElementsAre(Change{11'000, "scout", "stored hall@1, 12.3 m, active"}));
  EXPECT_EQ(Told().kept_since_unix_ms, kBegin);
}

TEST_F(HistoryTest, WhatIsBeingTaughtIsNotToldYetAndHowItEndedIs) {
  auto info = Store(1, 11'000);
  info.state = route::RouteState::kTeaching;
  Note({info}, "", 12'000);
  EXPECT_THAT(Told().changes, IsEmpty());
  info.state = route::RouteState::kComplete;
  info.cut_off = true;
  Note({info}, "", 12'000);
  EXPECT_THAT(Told().changes,
              ElementsAre(Change{11'000, "scout", "stored hall@1, 12.3 m, cut off"}));
}

TEST_F(HistoryTest, OfWhatWasThereBeforeItsChangesAloneAreTold) {
  auto info = Store(1, kBegin - 1);
  Note({info}, "", 11'000);
  EXPECT_THAT(Told().changes, IsEmpty());
  info.standing = route::Standing::kActive;
  ++info.edition;
  Note({info}, "desk", 12'000);
  EXPECT_THAT(Told().changes, ElementsAre(Change{12'000, "desk", "activated hall@1"}));
}

TEST_F(HistoryTest, EachLabelThatAnOperatorChangesIsToldOnceAndByWhom) {
  auto first = Store(1, 1);
  auto second = Store(2, 1);
  first.standing = route::Standing::kActive;
  first.tags = {"dry", "wet"};
  Note({first, second}, "", 11'000);
  first.standing = route::Standing::kStaged;
  second.standing = route::Standing::kActive;
  Note({first, second}, "desk", 12'000);
  first.standing = route::Standing::kRetired;
  first.tags = {"night", "wet"};
  first.description = "by the door";
  Note({first}, "", 13'000);
  first.name = second.name = "aisle";
  Note({first, second}, "desk", 14'000);
  first.standing = route::Standing::kDeleted;
  Note({first}, "server", 15'000);
  Note({first}, "", 16'000);
  EXPECT_THAT(Told(12'000).changes, ElementsAre(Change{12'000, "desk", "activated hall@2"},
                                                Change{13'000, "", "retired hall@1"},
                                                Change{13'000, "", "tagged hall@1 night"},
                                                Change{13'000, "", "untagged hall@1 dry"},
                                                Change{13'000, "", "described hall@1: by the door"},
                                                Change{14'000, "desk", "renamed hall to aisle"},
                                                Change{15'000, "server", "deleted aisle@1"}));
  EXPECT_THAT(Told(15'001).changes, IsEmpty());
}

TEST_F(HistoryTest, ALongHistoryIsToldInPages) {
  std::vector<Change> made;
  for (int i = 0; i < 2500; ++i) made.push_back({kBegin + i, "desk", "close hall"});
  ASSERT_TRUE(history_->Add(made));
  EXPECT_EQ(Told().changes, made);
  EXPECT_THAT(Told(kBegin + 2000).changes, SizeIs(500));
}

}  // namespace
}  // namespace trailcast::server
