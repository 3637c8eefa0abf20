#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "services/store/route_store.h"
#include "tests/support/places.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/golden_route.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// tests/golden/routes-v4.db and routes-v5.db.
class StoreUpgrade : public testing::TestWithParam<int> {
 protected:
  StoreUpgrade() {
    fs::copy_file(fs::path(SourceDir()) / fmt::format("tests/golden/routes-v{}.db", GetParam()),
                  file_);
    fs::permissions(file_, fs::perms::owner_all);
  }
  void Execute(const char* sql) const {
    sqlite3* db = nullptr;
    ASSERT_EQ(sqlite3_open(file_.c_str(), &db), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
    sqlite3_close(db);
  }

  test::TempDir folder_;
  const fs::path file_ = folder_ / "routes.db";
  const test::TaughtRoute taught_ = GetParam() == 4 ? test::TeachSamples(2) : GoldenRoute();
};

INSTANTIATE_TEST_SUITE_P(Versions, StoreUpgrade, testing::Values(4, 5));

TEST_P(StoreUpgrade, WhatWasHeldIsThere) {
  for (int opened = 0; opened < 2; ++opened) {
    auto store = OpenSqliteStore(file_);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->FindRoute(taught_.info.key).value(), taught_.info);
    EXPECT_EQ((*store)->ListRoutes().value(), std::vector{taught_.info});
    for (const route::SegmentPiece& piece : taught_.pieces) {
      EXPECT_EQ((*store)->ReadSegment(piece.key, piece.index).value(), piece);
      EXPECT_EQ((*store)->FindContent(piece.digest).value(), piece.bytes);
    }
    EXPECT_THAT((*store)->Verify().value(), testing::IsEmpty());
  }
}

TEST_P(StoreUpgrade, FoundByTagAndPlaceAsBefore) {
  auto store = OpenSqliteStore(file_).value();
  EXPECT_EQ(store->QueryRoutes({.tags = {"night"}}).value().routes.size(), 1U);
  EXPECT_EQ(store->QueryRoutes({.near = {{*taught_.info.place, 10.0}}}).value().routes.size(), 1U);
}

TEST_P(StoreUpgrade, WhatWasDamagedStaysDamaged) {
  Execute("UPDATE route SET name = 'hell'");
  auto store = OpenSqliteStore(file_);
  ASSERT_TRUE(store) << store.error().message;
  const auto found = (*store)->FindRoute(taught_.info.key);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCorrupt);
}

TEST_P(StoreUpgrade, ReceiptsAndTombstonesAreKept) {
  if (GetParam() == 4) Execute("UPDATE segment SET receipted = 1 WHERE number = 0");
  auto store = OpenSqliteStore(file_).value();
  EXPECT_EQ(store->UnreceiptedSegments(taught_.info.key).value(), std::vector{SegmentIndex(1)});
  if (GetParam() == 4) return;  // that file has no tombstone
  EXPECT_EQ(store->FindRoute(GoldenTombstone().key).value(), GoldenTombstone());
  EXPECT_EQ(store->FindTeachings(taught_.info.key.route).value().size(), 2U);
}

}  // namespace
}  // namespace trailcast::store
