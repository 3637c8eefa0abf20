#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace trailcast::store {

// Works in the caller's transaction, and needs an empty database.
void CreateTables(SQLite::Database& db);

}  // namespace trailcast::store
