#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace trailcast::store {

// A SQLite file of a server's own, beside its routes.
struct OwnFile {
  int id = 0;  // in SQLite's header, as that of a route store has its own
  int version = 0;
  const char* tables = "";
  const char* holds = "";  // "missions"
};

// Makes the tables in an empty file. Throws SQLite's exceptions, SQLITE_NOTADB for another file.
// Who has it locked is another server, not somebody who is done in a moment.
void PrepareOwnFile(SQLite::Database& db, const OwnFile& file);

}  // namespace trailcast::store
