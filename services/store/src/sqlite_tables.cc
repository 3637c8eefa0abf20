#include "services/store/src/sqlite_tables.h"

#include <fmt/format.h>

namespace trailcast::store {
namespace {

// The description of a revision: `info`, in the route format, and columns made from it
// (row_values.h). `seal` is the digest of those bytes, because SQLite itself does not notice a
// changed one.
constexpr const char* kRouteRow = R"(
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  revision INTEGER NOT NULL,
  name TEXT NOT NULL,
  scout TEXT NOT NULL,
  camera TEXT NOT NULL,
  taught_unix_ms INTEGER NOT NULL,
  state INTEGER NOT NULL,
  segment_count INTEGER NOT NULL,
  length_m REAL NOT NULL,
  standing INTEGER NOT NULL,
  place_frame INTEGER,
  place_east REAL,
  place_north REAL,
  info BLOB NOT NULL,
  seal BLOB NOT NULL,
  grown_unix_ms INTEGER NOT NULL,
  UNIQUE (route, teaching)
)";

constexpr const char* kRouteIndices = R"(
CREATE INDEX route_by_name ON route (name, route, teaching);
CREATE INDEX route_by_time ON route (taught_unix_ms, route, teaching);
CREATE INDEX route_by_length ON route (length_m, route, teaching);
CREATE INDEX route_by_scout ON route (scout);
)";

// One of several equal segments, whichever route's they are, has the bytes; in the others they are
// NULL. A separate table of bytes would be simpler to read, but a damaged page of names would then
// cost thirty segments instead of one. Segments may arrive before their route does, so neither
// table refers to the other. Four bytes of a digest, which is as good as random, find the row and
// keep the index small. `receipt` has the segments that a scout got acknowledged; servers write
// none.
constexpr const char* kSegmentTables = R"(
CREATE TABLE segment (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  number INTEGER NOT NULL,
  digest BLOB NOT NULL,
  seal BLOB NOT NULL,
  bytes BLOB,
  PRIMARY KEY (route, teaching, number)
) STRICT;
CREATE INDEX segment_by_digest ON segment (substr(digest, 1, 4));
CREATE TABLE receipt (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  number INTEGER NOT NULL,
  PRIMARY KEY (route, teaching, number)
) STRICT, WITHOUT ROWID;
)";

constexpr const char* kSearchTables = R"(
CREATE TABLE route_tag (
  tag TEXT NOT NULL,
  id INTEGER NOT NULL,
  PRIMARY KEY (tag, id)
) STRICT, WITHOUT ROWID;
CREATE INDEX route_tag_by_id ON route_tag (id);
CREATE VIRTUAL TABLE route_place USING rtree(
  id, east_low, east_high, north_low, north_high, +frame INTEGER);
)";

}  // namespace

// Table `route` has what is offered and searched. Deleted revisions are in another one, so that
// they do not slow down searches.
void CreateTables(SQLite::Database& db) {
  for (const char* table : {"route", "tombstone"}) {
    db.exec(fmt::format("CREATE TABLE {} (id INTEGER PRIMARY KEY,{}) STRICT", table, kRouteRow));
  }
  db.exec(kRouteIndices);
  db.exec(kSegmentTables);
  db.exec(kSearchTables);
}

}  // namespace trailcast::store
