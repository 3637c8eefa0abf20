#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <string>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

// Opens a database with our tables, settings and limit, and creates it if the file is empty. The
// caller holds the file's lock and has checked it (StoreFile).
[[nodiscard]] Result<std::unique_ptr<SQLite::Database>> OpenDatabase(
    const std::filesystem::path& file, const SqliteOptions& options);

// Converts an exception of SQLite while `doing` something with `file` to one of our errors, with
// what to do.
[[nodiscard]] Error ToError(const SQLite::Exception& exception, const std::filesystem::path& file,
                            const std::string& doing, const char* what = "route store");

}  // namespace trailcast::store
