#include "services/store/src/sqlite_tables.h"

#include <fmt/format.h>

#include "services/base/unix_time.h"
#include "services/store/src/rows.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

// What is known of a revision. `seal` is a digest of what a row says (rows.cc): SQLite itself does
// not notice a changed byte.
constexpr const char* kRouteRow = R"(
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  teaching INTEGER NOT NULL CHECK (teaching >= 0),
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
  description TEXT NOT NULL DEFAULT '',
  standing INTEGER NOT NULL DEFAULT 0 CHECK (standing BETWEEN 0 AND 3),
  edition INTEGER NOT NULL DEFAULT 0 CHECK (edition BETWEEN 0 AND 4294967295),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  cut_off INTEGER NOT NULL CHECK (cut_off IN (0, 1)),
  grown_unix_ms INTEGER NOT NULL,
  UNIQUE (route, teaching)
)";

constexpr const char* kRouteIndices = R"(
CREATE INDEX route_by_name ON route (name, route, teaching);
CREATE INDEX route_by_time ON route (taught_unix_ms, route, teaching);
CREATE INDEX route_by_length ON route (length_m, route, teaching);
CREATE INDEX route_by_scout ON route (scout);
)";

// Segments may arrive before their route does, so neither table refers to the other.
constexpr const char* kOtherTables = R"(
CREATE TABLE route_tag (
  tag TEXT NOT NULL,
  id INTEGER NOT NULL,
  PRIMARY KEY (tag, id)
) STRICT, WITHOUT ROWID;
CREATE INDEX route_tag_by_id ON route_tag (id);
CREATE VIRTUAL TABLE route_place USING rtree(
  id, east_low, east_high, north_low, north_high, +frame INTEGER);
)";

// Of segments that are alike, whichever route's they are, one has the bytes; in the others they are
// NULL. A table of bytes apart would be simpler to read, and a damaged page of names would cost
// thirty segments instead of one.
constexpr const char* kSegmentTable = R"(
CREATE TABLE segment (
  route TEXT NOT NULL CHECK (length(route) BETWEEN 1 AND 64),
  teaching INTEGER NOT NULL CHECK (teaching >= 0),
  number INTEGER NOT NULL CHECK (number BETWEEN 0 AND 4294967295),
  receipted INTEGER NOT NULL DEFAULT 0 CHECK (receipted IN (0, 1)),
  digest BLOB NOT NULL CHECK (length(digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  bytes BLOB CHECK (length(bytes) <= 1048576),
  PRIMARY KEY (route, teaching, number)
) STRICT;
CREATE INDEX segment_unreceipted ON segment (route, teaching, number) WHERE receipted = 0;
CREATE INDEX segment_by_digest ON segment (digest);
)";

// Table `route` is what is offered and searched; deleted revisions are apart, so that searching
// costs nothing for them.
void CreateRowTables(SQLite::Database& db) {
  for (const char* table : {"route", "tombstone"}) {
    db.exec(fmt::format("CREATE TABLE {} (id INTEGER PRIMARY KEY,{}) STRICT", table, kRouteRow));
  }
  db.exec(kRouteIndices);
  db.exec(kSegmentTable);
}

// Of rows that fit the seal that they have.
void SealAnew(SQLite::Database& db, const char* table) {
  SQLite::Statement select(db, fmt::format("SELECT {}, id FROM {}", kRouteColumns, table));
  SQLite::Statement seal(db, fmt::format("UPDATE {} SET seal = ? WHERE id = ?", table));
  while (select.executeStep()) {
    const auto info = ReadRouteOf4(select);
    if (!info) continue;
    BindDigest(seal, 1, Seal(*info));
    seal.bind(2, select.getColumn(kRouteColumnCount).getInt64());
    seal.exec();
    seal.reset();
  }
}

}  // namespace

void CreateTables(SQLite::Database& db) {
  CreateRowTables(db);
  db.exec(kOtherTables);
}

// Version 4 knew teachings by their revision's number, and sealed rows without their labels. What
// failed its seal then fails it now.
void BringUpFrom4(SQLite::Database& db) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  for (const char* table : {"route", "tombstone", "segment"}) {
    db.exec(fmt::format("ALTER TABLE {0} RENAME TO {0}_4", table));
  }
  for (const char* index : {"route_by_name", "route_by_time", "route_by_length", "route_by_scout",
                            "segment_unreceipted", "segment_by_digest"}) {
    db.exec(fmt::format("DROP INDEX {}", index));
  }
  CreateRowTables(db);
  for (const char* table : {"route", "tombstone"}) {
    db.exec(
        fmt::format("INSERT INTO {0} SELECT *, revision, 0, {1} FROM {0}_4", table, NowUnixMs()));
    SealAnew(db, table);
  }
  db.exec(
      "INSERT INTO segment SELECT route, revision, number, receipted, digest, seal, bytes FROM "
      "segment_4");
  for (const char* table : {"route_4", "tombstone_4", "segment_4"}) {
    db.exec(fmt::format("DROP TABLE {}", table));
  }
  db.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  transaction.commit();
}

}  // namespace trailcast::store
