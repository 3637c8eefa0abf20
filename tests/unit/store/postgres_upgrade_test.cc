#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "services/store/route_store.h"
#include "tests/support/places.h"
#include "tests/support/postgres_server.h"
#include "tests/unit/store/golden_route.h"

namespace trailcast::store {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

// tests/golden/routes-postgres-v2.sql, in a database of its own.
class PostgresUpgrade : public testing::Test {
 protected:
  PostgresUpgrade() {
    std::ifstream in(std::filesystem::path(SourceDir()) / "tests/golden/routes-postgres-v2.sql");
    test::PostgresServer::Execute(
        url_, {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
  }

  const std::string url_ = test::PostgresServer::Shared().CreateDatabase();
  const test::TaughtRoute taught_ = GoldenRoute();
};

TEST_F(PostgresUpgrade, WhatVersion2HeldIsThere) {
  for (int opened = 0; opened < 2; ++opened) {
    const auto store = OpenPostgresStore(url_);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->FindRoute(taught_.info.key).value(), taught_.info);
    EXPECT_EQ((*store)->FindRoute(GoldenTombstone().key).value(), GoldenTombstone());
    EXPECT_EQ((*store)->QueryRoutes({.tags = {"night"}}).value().routes.size(), 1U);
    EXPECT_EQ((*store)->QueryRoutes({.near = {{*taught_.info.place, 10.0}}}).value().total, 1U);
    for (const route::SegmentPiece& piece : taught_.pieces) {
      EXPECT_EQ((*store)->ReadSegment(piece.key, piece.index).value(), piece);
    }
    EXPECT_EQ((*store)->UnreceiptedSegments(taught_.info.key).value(),
              std::vector{SegmentIndex(1)});
    EXPECT_THAT((*store)->Verify().value(), IsEmpty());
  }
}

TEST_F(PostgresUpgrade, ItIsWrittenToAsANewOne) {
  const auto store = OpenPostgresStore(url_).value();
  test::TaughtRoute more = test::TeachSamples(3);
  for (route::SegmentPiece& piece : more.pieces) piece.key.teaching = TeachingId(7);
  more.info.key.teaching = TeachingId(7);
  ASSERT_TRUE(store->AppendSegments(more.pieces));
  ASSERT_TRUE(store->PutRoute(more.info));
  route::RouteInfo gone = taught_.info;
  gone.standing = route::Standing::kDeleted;
  ++gone.edition;
  ASSERT_TRUE(store->PutRoute(gone));
  EXPECT_EQ(store->ListRoutes().value(), std::vector{more.info});
  EXPECT_THAT(store->Verify().value(), IsEmpty());
}

TEST_F(PostgresUpgrade, WhatWasDamagedStaysDamaged) {
  test::PostgresServer::Execute(url_, "UPDATE trailcast.route SET scout = 'scout-2'");
  const auto store = OpenPostgresStore(url_).value();
  EXPECT_EQ(store->FindRoute(taught_.info.key).error().code, ErrorCode::kCorrupt);
}

TEST_F(PostgresUpgrade, ServersThatStartAtOnceDoItOnce) {
  std::array<Result<std::unique_ptr<RouteStore>>, 3> opened;
  {
    std::vector<std::jthread> threads;
    threads.reserve(opened.size());
    for (auto& each : opened) threads.emplace_back([&] { each = OpenPostgresStore(url_); });
  }
  for (const auto& each : opened) {
    ASSERT_TRUE(each) << each.error().message;
    EXPECT_EQ((*each)->FindRoute(taught_.info.key).value(), taught_.info);
  }
}

TEST_F(PostgresUpgrade, OpenedForReadingItIsRefusedWithWhatToDo) {
  const auto store = OpenPostgresStore(url_, {.read_only = true});
  ASSERT_FALSE(store);
  EXPECT_THAT(store.error().message, HasSubstr("start a trailcast-server of this version on it"));
}

}  // namespace
}  // namespace trailcast::store
