#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include "services/store/route_store.h"
#include "tests/support/temp_dir.h"
#include "tests/unit/store/pieces.h"

namespace trailcast::store {
namespace {

using testing::IsEmpty;

// The tables of version 1, filled from those of today; what it had no column for is lost.
constexpr const char* kBackToVersion1 = R"(
BEGIN;
CREATE TABLE r1 AS SELECT * FROM route;
CREATE TABLE s1 AS SELECT * FROM segment;
DROP TABLE route_tag; DROP TABLE route_place; DROP TABLE route; DROP TABLE segment;
DROP TABLE tombstone;
CREATE TABLE route (
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  name TEXT NOT NULL CHECK (length(name) BETWEEN 1 AND 64),
  scout TEXT NOT NULL CHECK (length(scout) <= 64),
  camera TEXT NOT NULL CHECK (length(CAST(camera AS BLOB)) <= 128),
  image_width_px INTEGER NOT NULL CHECK (image_width_px BETWEEN 0 AND 65536),
  image_height_px INTEGER NOT NULL CHECK (image_height_px BETWEEN 0 AND 65536),
  taught_unix_ms INTEGER NOT NULL,
  state INTEGER NOT NULL CHECK (state IN (0, 1)),
  segment_count INTEGER NOT NULL CHECK (segment_count BETWEEN 0 AND 4294967295),
  length_m REAL NOT NULL,
  bytes INTEGER NOT NULL CHECK (bytes >= 0),
  manifest_digest BLOB NOT NULL CHECK (length(manifest_digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  PRIMARY KEY (route, revision)
) STRICT;
CREATE INDEX route_by_name ON route (name);
CREATE TABLE segment (
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  number INTEGER NOT NULL CHECK (number BETWEEN 0 AND 4294967295),
  receipted INTEGER NOT NULL DEFAULT 0 CHECK (receipted IN (0, 1)),
  digest BLOB NOT NULL CHECK (length(digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  bytes BLOB NOT NULL CHECK (length(bytes) <= 1048576),
  PRIMARY KEY (route, revision, number)
) STRICT;
CREATE INDEX segment_unreceipted ON segment (route, revision, number) WHERE receipted = 0;
INSERT INTO route SELECT route, revision, name, scout, camera, image_width_px, image_height_px,
  taught_unix_ms, state, segment_count, length_m, bytes, manifest_digest, seal FROM r1;
INSERT INTO segment SELECT route, revision, number, receipted, digest, seal, bytes FROM s1;
DROP TABLE r1; DROP TABLE s1;
PRAGMA user_version = 1;
COMMIT;
)";

// Those of version 3, likewise.
constexpr const char* kBackToVersion3 = R"(
BEGIN;
CREATE TABLE s1 AS SELECT * FROM segment;
DROP TABLE segment;
CREATE TABLE segment (
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  number INTEGER NOT NULL CHECK (number BETWEEN 0 AND 4294967295),
  receipted INTEGER NOT NULL DEFAULT 0 CHECK (receipted IN (0, 1)),
  digest BLOB NOT NULL CHECK (length(digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  bytes BLOB NOT NULL CHECK (length(bytes) <= 1048576),
  PRIMARY KEY (route, revision, number)
) STRICT;
CREATE INDEX segment_unreceipted ON segment (route, revision, number) WHERE receipted = 0;
INSERT INTO segment SELECT route, revision, number, receipted, digest, seal, bytes FROM s1;
DROP TABLE s1;
PRAGMA user_version = 3;
COMMIT;
)";

// Those of version 2: its segments are as in version 3.
constexpr const char* kBackToVersion2 = R"(
BEGIN;
CREATE TABLE r1 AS SELECT * FROM route;
DROP TABLE route; DROP TABLE tombstone;
CREATE TABLE route (
  id INTEGER PRIMARY KEY,
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  name TEXT NOT NULL CHECK (length(name) BETWEEN 1 AND 64),
  scout TEXT NOT NULL CHECK (length(scout) <= 64),
  camera TEXT NOT NULL CHECK (length(CAST(camera AS BLOB)) <= 128),
  image_width_px INTEGER NOT NULL CHECK (image_width_px BETWEEN 0 AND 65536),
  image_height_px INTEGER NOT NULL CHECK (image_height_px BETWEEN 0 AND 65536),
  taught_unix_ms INTEGER NOT NULL,
  state INTEGER NOT NULL CHECK (state IN (0, 1)),
  segment_count INTEGER NOT NULL CHECK (segment_count BETWEEN 0 AND 4294967295),
  length_m REAL NOT NULL,
  bytes INTEGER NOT NULL CHECK (bytes >= 0),
  manifest_digest BLOB NOT NULL CHECK (length(manifest_digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  tags TEXT NOT NULL,
  place_frame INTEGER CHECK (place_frame IN (1, 2)),
  place_east REAL,
  place_north REAL,
  UNIQUE (route, revision)
) STRICT;
CREATE INDEX route_by_name ON route (name, route, revision);
CREATE INDEX route_by_time ON route (taught_unix_ms, route, revision);
CREATE INDEX route_by_length ON route (length_m, route, revision);
CREATE INDEX route_by_scout ON route (scout);
INSERT INTO route SELECT id, route, revision, name, scout, camera, image_width_px, image_height_px,
  taught_unix_ms, state, segment_count, length_m, bytes, manifest_digest, seal, tags, place_frame,
  place_east, place_north FROM r1;
DROP TABLE r1;
PRAGMA user_version = 2;
COMMIT;
)";

// Makes the store in `file` one of an older version.
void Age(const std::filesystem::path& file, const char* sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &db), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  sqlite3_close(db);
}

void ExpectEverything(const std::filesystem::path& file, const route::RouteInfo& yard) {
  for (int opening = 0; opening < 2; ++opening) {
    const auto store = OpenSqliteStore(file);
    ASSERT_TRUE(store) << store.error().message;
    EXPECT_EQ((*store)->FindRoute(kYard).value(), yard);
    EXPECT_EQ((*store)->ReadSegment(kYard, SegmentIndex(2)).value(), Piece(2));
    EXPECT_EQ((*store)->UnreceiptedSegments(kYard).value(), Indices({0, 2}));
    EXPECT_EQ((*store)->QueryRoutes({.name = "yard", .tags = yard.tags}).value().total, 1U);
    EXPECT_THAT((*store)->Verify().value(), IsEmpty());
  }
}

void Fill(const std::filesystem::path& file, const route::RouteInfo& yard) {
  const auto store = OpenSqliteStore(file).value();
  ASSERT_TRUE(store->AppendSegments(Pieces({0, 1, 2})));
  ASSERT_TRUE(store->PutRoute(yard));
  ASSERT_TRUE(store->MarkReceipted(kYard, Indices({1})));
}

TEST(Upgrade, StoreOfVersion1KeepsEverything) {
  test::TempDir dir;
  const auto file = dir / "routes.db";
  Fill(file, Complete(3));
  Age(file, kBackToVersion1);
  ExpectEverything(file, Complete(3));
}

TEST(Upgrade, StoreOfVersion2KeepsEverything) {
  test::TempDir dir;
  const auto file = dir / "routes.db";
  route::RouteInfo yard = Complete(3);
  yard.tags = {"night"};
  yard.place = {route::Place::Frame::kSite, 1.0, 2.0};
  Fill(file, yard);
  Age(file, kBackToVersion3);
  Age(file, kBackToVersion2);
  ExpectEverything(file, yard);
}

TEST(Upgrade, StoreOfVersion3KeepsEverythingAndItsTombstones) {
  test::TempDir dir;
  const auto file = dir / "routes.db";
  route::RouteInfo gone = Complete(1);
  gone.key.revision = RevisionNumber(9);
  gone.standing = route::Standing::kDeleted;
  gone.edition = 1;
  Fill(file, Complete(3));
  ASSERT_TRUE(OpenSqliteStore(file).value()->PutRoute(gone));
  Age(file, kBackToVersion3);
  ExpectEverything(file, Complete(3));
  EXPECT_EQ(OpenSqliteStore(file).value()->FindRoute(gone.key).value(), gone);
}

}  // namespace
}  // namespace trailcast::store
