#include "services/store/src/own_file.h"

#include <sqlite3.h>

#include <string>

namespace trailcast::store {

void PrepareOwnFile(SQLite::Database& db, const OwnFile& file) {
  db.exec("PRAGMA locking_mode = EXCLUSIVE");
  const int id = db.execAndGet("PRAGMA application_id").getInt();
  const int version = db.execAndGet("PRAGMA user_version").getInt();
  const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_schema").getInt() == 0;
  if (!empty && (id != file.id || version != file.version)) {
    throw SQLite::Exception(
        "it holds no " + std::string(file.holds) + ", or those of another version", SQLITE_NOTADB);
  }
  db.exec("PRAGMA journal_mode = WAL");
  db.exec("PRAGMA synchronous = FULL");
  db.exec("PRAGMA journal_size_limit = 4194304");
  db.exec("PRAGMA trusted_schema = OFF");
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  if (empty) {
    db.exec("PRAGMA application_id = " + std::to_string(file.id));
    db.exec("PRAGMA user_version = " + std::to_string(file.version));
    db.exec(file.tables);
  }
  transaction.commit();
}

}  // namespace trailcast::store
