#include "services/records/history_store.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "services/records/network_store.h"
#include "tests/support/pieces.h"
#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

using network::Change;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class HistoryStoreTest : public testing::Test {
 protected:
  void SetUp() override { Reopen(); }
  void Reopen(std::int64_t most_kept = HistoryStore::kMostKept) {
    store_.reset();
    auto opened = HistoryStore::Open(file_, most_kept);
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = std::move(*opened);
  }
  std::vector<Change> Since(std::int64_t unix_ms) {
    return store_->Since(unix_ms, 0, 1000).value();
  }

  test::TempDir folder_;
  std::filesystem::path file_ = folder_ / "history";
  std::unique_ptr<HistoryStore> store_;
};

TEST_F(HistoryStoreTest, ChangesAreThereAfterARestartInTheOrderInWhichTheyWereMade) {
  const Change closed{2000, "desk", "close hall 3..7"};
  const Change stored{1000, "scout", "stored hall@1"};  // heard of later
  const Change activated{2000, "", "activated hall@1"};
  ASSERT_TRUE(store_->Note(std::vector{closed}, {}));
  ASSERT_TRUE(store_->Note(std::vector{stored, activated}, {}));
  Reopen();
  EXPECT_THAT(Since(0), ElementsAre(stored, closed, activated));
  EXPECT_THAT(Since(1001), ElementsAre(closed, activated));
  EXPECT_THAT(Since(2001), IsEmpty());
  EXPECT_THAT(store_->Since(0, 1, 1).value(), ElementsAre(closed));
}

TEST_F(HistoryStoreTest, ItIsKeptSinceItWasMade) {
  EXPECT_EQ(store_->KeptSince(5000), 5000);
  Reopen();
  EXPECT_EQ(store_->KeptSince(9000), 5000);
}

TEST_F(HistoryStoreTest, TheOldestGoAndSinceWhenItIsKeptIsSaid) {
  Reopen(3);
  ASSERT_EQ(store_->KeptSince(1000), 1000);
  for (std::int64_t at = 1001; at <= 1005; ++at) {
    ASSERT_TRUE(store_->Note(std::vector{Change{at, "desk", "open hall"}}, {}));
  }
  EXPECT_THAT(Since(0), SizeIs(3));
  EXPECT_EQ(Since(0).front().at_unix_ms, 1003);
  EXPECT_EQ(store_->KeptSince(9000), 1003);
}

TEST_F(HistoryStoreTest, TheOldestGoInRunsThatAreShortToo) {
  for (int run = 0; run < 60; ++run) {
    Reopen(100);
    for (int i = 0; i < 2; ++i) {
      ASSERT_TRUE(store_->Note(std::vector{Change{run, "desk", "open hall"}}, {}));
    }
  }
  EXPECT_THAT(Since(0), SizeIs(101)) << "the last run's second change is one too many";
}

TEST_F(HistoryStoreTest, ARevisionIsNotedAsItWasLastUntilItIsDeleted) {
  const route::RouteKey key = test::KeyNumber(1);
  EXPECT_EQ(store_->Noted(key).value(), std::nullopt);
  route::RouteInfo info = test::InfoOf(key, test::PiecesOf(key, 2), route::RouteState::kComplete);
  ASSERT_TRUE(store_->Note({}, std::vector{info}));
  info.name = "aisle";
  ASSERT_TRUE(store_->Note({}, std::vector{info}));
  Reopen();
  EXPECT_EQ(store_->Noted(key).value(), info);
  info.standing = route::Standing::kDeleted;
  ASSERT_TRUE(store_->Note({}, std::vector{info}));
  EXPECT_EQ(store_->Noted(key).value(), std::nullopt);
}

TEST_F(HistoryStoreTest, AnotherFileIsLeftAsItIs) {
  ASSERT_TRUE(NetworkStore::Open(folder_ / "joints"));
  const auto opened = HistoryStore::Open(folder_ / "joints");
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, ErrorCode::kCorrupt);
  EXPECT_THAT(opened.error().message, HasSubstr("holds no history"));
}

}  // namespace
}  // namespace trailcast::store
