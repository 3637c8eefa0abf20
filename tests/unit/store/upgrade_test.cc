#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>

#include "services/store/route_store.h"
#include "tests/support/taught_route.h"
#include "tests/support/temp_dir.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// tests/golden/routes-v4.db: a store of version 4 with the route that TeachSamples(2) makes.
class StoreUpgrade : public testing::Test {
 protected:
  StoreUpgrade() {
    fs::copy_file(fs::path(TRAILCAST_SOURCE_DIR) / "tests/golden/routes-v4.db", file_);
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
  const test::TaughtRoute taught_ = test::TeachSamples(2);
};

TEST_F(StoreUpgrade, WhatVersion4HeldIsThereUnderItsRevisionsNumber) {
  for (int opened = 0; opened < 2; ++opened) {
    auto store = OpenSqliteStore(file_);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->FindRoute(taught_.info.key).value(), taught_.info);
    EXPECT_EQ((*store)->ListRoutes().value(), std::vector{taught_.info});
    for (const route::SegmentPiece& piece : taught_.pieces) {
      EXPECT_EQ((*store)->ReadSegment(piece.key, piece.index).value(), piece);
    }
    const auto known = (*store)->FindTeachings(taught_.info.key.route).value();
    ASSERT_EQ(known.size(), 1U);
    EXPECT_EQ(known[0].revision, RevisionNumber(2));
    EXPECT_THAT((*store)->Verify().value(), testing::IsEmpty());
  }
}

TEST_F(StoreUpgrade, FoundByTagAndPlaceAsBefore) {
  auto store = OpenSqliteStore(file_).value();
  EXPECT_EQ(store->QueryRoutes({.tags = {"night"}}).value().routes.size(), 1U);
  EXPECT_EQ(store->QueryRoutes({.near = {{*taught_.info.place, 10.0}}}).value().routes.size(), 1U);
}

TEST_F(StoreUpgrade, WhatWasDamagedStaysDamaged) {
  Execute("UPDATE route SET name = 'hell'");
  auto store = OpenSqliteStore(file_);
  ASSERT_TRUE(store) << store.error().message;
  const auto found = (*store)->FindRoute(taught_.info.key);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCorrupt);
}

}  // namespace
}  // namespace trailcast::store
