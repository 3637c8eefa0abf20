#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/store/compiled_statements.h"
#include "services/store/sqlite_database.h"

namespace trailcast::store {

// A SQLite file of a server's own, beside its routes.
struct OwnFile {
  int id = 0;  // in SQLite's header, as that of a route store has its own
  int version = 0;
  const char* tables = "";
  const char* holds = "";   // "missions"
  const char* called = "";  // "mission store", in errors
};

// Such a file, open.
struct OwnDatabase {
  // Makes the tables in an empty file. Throws SQLite's exceptions, SQLITE_NOTADB for another file.
  // Who has it locked is another server, not somebody who is done in a moment.
  OwnDatabase(std::filesystem::path file, const OwnFile& what);

  // Runs `work`, which may throw SQLite's exceptions.
  template <typename Work>
  static auto Guard(const std::filesystem::path& file, const OwnFile& what,
                    const std::string& doing, const Work& work) -> decltype(work()) {
    try {
      return work();
    } catch (const SQLite::Exception& exception) {
      return tl::unexpected(ToError(exception, file, doing, what.called));
    }
  }
  template <typename Work>
  auto Guarded(const std::string& doing, const Work& work) -> decltype(work()) {
    return Guard(path, own, doing, work);
  }

  [[nodiscard]] std::int64_t Count(const char* sql);

  std::filesystem::path path;
  OwnFile own;
  SQLite::Database db;
  CompiledStatements compiled;
};

}  // namespace trailcast::store
