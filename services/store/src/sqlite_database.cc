#include "services/store/sqlite_database.h"

#include <sqlite3.h>

#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

// Bounds the wait for somebody's sqlite3 shell; our own processes exclude each other beforehand.
constexpr int kBusyTimeoutMs = 2000;
constexpr int kPageBytes = 4096;
// Set before the first use of the log, which then needs no file of shared memory (a full disk under
// one would kill the process).
constexpr const char* kExclusive = "PRAGMA locking_mode = EXCLUSIVE";

// What is known of a revision. `seal` is a digest of what a row says (rows.cc): SQLite itself does
// not notice a changed byte.
constexpr const char* kRouteRow = R"(
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
  description TEXT NOT NULL DEFAULT '',
  standing INTEGER NOT NULL DEFAULT 0 CHECK (standing BETWEEN 0 AND 3),
  edition INTEGER NOT NULL DEFAULT 0 CHECK (edition BETWEEN 0 AND 4294967295),
  UNIQUE (route, revision)
)";

constexpr const char* kRouteIndices = R"(
CREATE INDEX route_by_name ON route (name, route, revision);
CREATE INDEX route_by_time ON route (taught_unix_ms, route, revision);
CREATE INDEX route_by_length ON route (length_m, route, revision);
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
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 4294967295),
  number INTEGER NOT NULL CHECK (number BETWEEN 0 AND 4294967295),
  receipted INTEGER NOT NULL DEFAULT 0 CHECK (receipted IN (0, 1)),
  digest BLOB NOT NULL CHECK (length(digest) = 32),
  seal BLOB NOT NULL CHECK (length(seal) = 32),
  bytes BLOB CHECK (length(bytes) <= 1048576),
  PRIMARY KEY (route, revision, number)
) STRICT;
CREATE INDEX segment_unreceipted ON segment (route, revision, number) WHERE receipted = 0;
CREATE INDEX segment_by_digest ON segment (digest);
)";

// Table `route` is what is offered and searched; deleted revisions are apart, so that searching
// costs nothing for them.
void CreateTables(SQLite::Database& db) {
  for (const char* table : {"route", "tombstone"}) {
    db.exec(fmt::format("CREATE TABLE {} (id INTEGER PRIMARY KEY,{}) STRICT", table, kRouteRow));
  }
  db.exec(kRouteIndices);
  db.exec(kOtherTables);
  db.exec(kSegmentTable);
}

// All in one transaction with the marks in the header: an interrupted making leaves an empty file.
void MakeStore(SQLite::Database& db) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  db.exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  db.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  CreateTables(db);
  transaction.commit();
}

void Configure(SQLite::Database& db, const SqliteOptions& options) {
  if (db.execAndGet("PRAGMA journal_mode = WAL").getString() != "wal") {
    throw SQLite::Exception("the file system does not support a write-ahead log", SQLITE_CANTOPEN);
  }
  db.exec("PRAGMA synchronous = FULL");  // on the disk when a commit returns, not soon after
  db.exec("PRAGMA journal_size_limit = 4194304");
  db.exec("PRAGMA cache_size = -2048");  // KiB
  db.exec("PRAGMA cell_size_check = ON");
  db.exec("PRAGMA trusted_schema = OFF");
  if (options.max_bytes > 0) {
    const std::uint64_t pages = std::max<std::uint64_t>(options.max_bytes / kPageBytes, 1);
    db.exec(fmt::format("PRAGMA max_page_count = {}", pages));
  }
}

std::string DescribeTables(SQLite::Database& db) {
  SQLite::Statement select(db, "SELECT type, name, sql FROM sqlite_schema ORDER BY type, name");
  std::string description;
  while (select.executeStep()) {
    for (int i = 0; i < 3; ++i) description += select.getColumn(i).getString() + "\n";
  }
  return description;
}

// Cheap: reads the first pages. A byte changed in a table's definition changes what it means.
void CheckTables(SQLite::Database& db) {
  SQLite::Database fresh(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  CreateTables(fresh);
  if (DescribeTables(db) != DescribeTables(fresh)) {
    throw SQLite::Exception("the definitions of its tables are damaged", SQLITE_CORRUPT);
  }
}

}  // namespace

Error ToError(const SQLite::Exception& exception, const std::filesystem::path& file,
              const std::string& doing) {
  const auto error = [&](ErrorCode code, std::string_view advice) {
    return Error{code, fmt::format("route store {}: {}: {}{}", file.string(), doing,
                                   exception.what(), advice)};
  };
  switch (exception.getErrorCode() & 0xFF) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return error(ErrorCode::kCorrupt,
                   "; verify the store, and restore a copy or move it away to begin a new one");
    case SQLITE_FULL:
      return error(ErrorCode::kUnavailable,
                   "; nothing of this was stored: free disk space or raise the store's limit");
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return error(ErrorCode::kConflict, "; close the other program that has the file open");
    case SQLITE_IOERR:
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_NOMEM:
      return error(ErrorCode::kUnavailable,
                   "; is the disk full, or the file or its folder not writable?");
    default:
      return error(ErrorCode::kInternal, "");
  }
}

Result<std::unique_ptr<SQLite::Database>> OpenDatabase(const std::filesystem::path& file,
                                                       const SqliteOptions& options) {
  try {
    auto db =
        std::make_unique<SQLite::Database>(file.string(), SQLite::OPEN_READWRITE, kBusyTimeoutMs);
    sqlite3_extended_result_codes(db->getHandle(), 1);
    db->exec(kExclusive);
    if (db->execAndGet("PRAGMA page_count").getInt64() == 0) MakeStore(*db);
    CheckTables(*db);
    Configure(*db, options);
    return db;
  } catch (const SQLite::Exception& exception) {
    return tl::unexpected(ToError(exception, file, "opening it"));
  }
}

}  // namespace trailcast::store
