#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace trailcast::store {

// In the caller's transaction, into an empty database.
void CreateTables(SQLite::Database& db);
// Makes a store of version 4 one of kSchemaVersion, or leaves it as it was.
void BringUpFrom4(SQLite::Database& db);

}  // namespace trailcast::store
