#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <memory>
#include <string>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

// A database with our tables, settings and limit, created if the file is empty. The caller holds
// the file's lock and has looked at it (StoreFile).
[[nodiscard]] Result<std::unique_ptr<SQLite::Database>> OpenDatabase(
    const std::filesystem::path& file, const SqliteOptions& options);

// What SQLite threw while `doing` something with `file`, as one of our errors with what to do.
[[nodiscard]] Error ToError(const SQLite::Exception& exception, const std::filesystem::path& file,
                            const std::string& doing, const char* what = "route store");

}  // namespace trailcast::store
