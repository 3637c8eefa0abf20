#include "services/records/src/own_file.h"

#include <sqlite3.h>

#include <string>
#include <utility>

#include "services/base/durable_file.h"

namespace trailcast::store {

OwnDatabase::OwnDatabase(std::filesystem::path file, const OwnFile& what)
    : path(std::move(file)),
      own(what),
      db(path.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE),
      compiled(db) {
  db.exec("PRAGMA locking_mode = EXCLUSIVE");
  const int id = db.execAndGet("PRAGMA application_id").getInt();
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (!empty && (id != own.id || version != own.version)) {
    throw SQLite::Exception(
        "it holds no " + std::string(own.holds) + ", or those of another version", SQLITE_NOTADB);
  }
  // SQLite waits until a file's contents are on the disk, but not for the file's name.
  if (empty && path != ":memory:" && SyncToDisk(FolderOf(path))) {
    throw SQLite::Exception("its folder cannot be written", SQLITE_CANTOPEN);
  }
  db.exec("PRAGMA journal_mode = WAL");
  db.exec("PRAGMA synchronous = FULL");
  db.exec("PRAGMA journal_size_limit = 4194304");
  db.exec("PRAGMA trusted_schema = OFF");
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  if (empty) {
    db.exec("PRAGMA application_id = " + std::to_string(own.id));
    db.exec("PRAGMA user_version = " + std::to_string(own.version));
    db.exec(own.tables);
  }
  db.exec(own.added);
  transaction.commit();
}

std::int64_t OwnDatabase::Count(const char* sql) {
  auto select = compiled.Take(sql);
  return select->executeStep() ? select->getColumn(0).getInt64() : 0;
}

}  // namespace trailcast::store
