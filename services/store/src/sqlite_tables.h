#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

namespace trailcast::store {

// In the caller's transaction, into an empty database.
void CreateTables(SQLite::Database& db);
// The part of it that other versions had otherwise: not the tables of tags and places.
void CreateRowTables(SQLite::Database& db);

}  // namespace trailcast::store
