#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace trailcast::store {

// In the caller's transaction, into an empty database.
void CreateTables(SQLite::Database& db);

}  // namespace trailcast::store
