#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"
#include "services/store/compiled_statements.h"
#include "services/store/sqlite_database.h"

namespace trailcast::store {

// A SQLite file of a server's own, beside its routes.
struct OwnFile {
  int id = 0;  // in SQLite's header, different from a route store's
  int version = 0;
  const char* tables = "";
  const char* holds = "";   // "missions"
  const char* called = "";  // "mission store", for errors
  // Tables of later programs that earlier ones can do without. They are made wherever they are
  // missing, and do not raise the version.
  const char* added = "";
};

// An open file of that kind.
struct OwnDatabase {
  // Makes the tables in an empty file. It throws SQLite's exceptions, and SQLITE_NOTADB for another
  // program's file. A lock means that another server has the file open, so waiting would not help.
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
  // Runs `work` in a transaction, which is rolled back if it fails.
  template <typename Work>
  auto AllOrNothing(const std::string& doing, const Work& work) -> decltype(work()) {
    return Guarded(doing, [&] {
      SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
      auto done = work();
      if (done) transaction.commit();
      return done;
    });
  }
  // Returns what `in` makes of each row.
  template <typename Value>
  Result<std::vector<Value>> Read(const std::string& doing, std::string_view sql,
                                  Value (*in)(SQLite::Statement&)) {
    return Guarded(doing, [&]() -> Result<std::vector<Value>> {
      auto select = compiled.Take(sql);
      std::vector<Value> all;
      while (select->executeStep()) all.push_back(in(*select));
      return all;
    });
  }

  // These throw SQLite's exceptions. The values are the parameters from the first on; an empty one
  // is NULL. Run returns how many rows are changed.
  template <typename... Values>
  int Run(std::string_view sql, const Values&... values) {
    auto statement = compiled.Take(sql);
    int parameter = 0;
    (Bind(*statement, ++parameter, values), ...);
    return statement->exec();
  }
  [[nodiscard]] std::int64_t Count(const char* sql);

  std::filesystem::path path;
  OwnFile own;
  SQLite::Database db;
  CompiledStatements compiled;

 private:
  template <typename Value>
  static void Bind(SQLite::Statement& statement, int parameter, const Value& value) {
    statement.bind(parameter, value);
  }
  template <typename Value>
  static void Bind(SQLite::Statement& statement, int parameter, const std::optional<Value>& value) {
    value ? statement.bind(parameter, *value) : statement.bind(parameter);
  }
};

}  // namespace trailcast::store
