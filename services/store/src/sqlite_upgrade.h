#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>

namespace trailcast::store {

// Makes a store of an older `version`, from kOldestSchemaVersion on, one of kSchemaVersion, or
// leaves it as it was. What was damaged stays damaged.
void BringUpToDate(SQLite::Database& db, std::uint32_t version);

}  // namespace trailcast::store
