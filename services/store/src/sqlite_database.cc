#include "services/store/sqlite_database.h"

#include <sqlite3.h>

#include "services/store/src/sqlite_tables.h"
#include "services/store/store_file.h"

namespace trailcast::store {
namespace {

// This bounds the wait for somebody's sqlite3 shell; our own processes exclude each other
// beforehand.
constexpr int kBusyTimeoutMs = 2000;
constexpr int kPageBytes = 4096;
// It is set before the first use of the log, which then needs no file of shared memory. A full disk
// under such a file would kill the process.
constexpr const char* kExclusive = "PRAGMA locking_mode = EXCLUSIVE";

// Makes everything in one transaction with the marks in the header, so that an interruption leaves
// an empty file.
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
  // FULL means on the disk when a commit returns; NORMAL soon after, in the order of the commits.
  db.exec(options.durability == SqliteOptions::Durability::kAtOnce ? "PRAGMA synchronous = FULL"
                                                                   : "PRAGMA synchronous = NORMAL");
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

// This is cheap, because it reads only the first pages. A changed byte in a table's definition
// changes its meaning.
void CheckTables(SQLite::Database& db) {
  SQLite::Database fresh(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  CreateTables(fresh);
  if (DescribeTables(db) != DescribeTables(fresh)) {
    throw SQLite::Exception("the definitions of its tables are damaged", SQLITE_CORRUPT);
  }
}

}  // namespace

Error ToError(const SQLite::Exception& exception, const std::filesystem::path& file,
              const std::string& doing, const char* what) {
  const auto error = [&](ErrorCode code, std::string_view advice) {
    return Error{
        code, fmt::format("{} {}: {}: {}{}", what, file.string(), doing, exception.what(), advice)};
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
