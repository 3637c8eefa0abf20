#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace trailcast::store {

// Statements that SQLite compiles once, for what is asked for every segment or route: compiling
// takes longer than answering. All are kept: not for SQL that is put together from a query.
class CompiledStatements {
 public:
  // A statement while it is in use; rows that it has not given yet are let go with it.
  class Lease {
   public:
    explicit Lease(SQLite::Statement& statement) : statement_(statement) {}
    ~Lease() { statement_.tryReset(); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;

    SQLite::Statement& operator*() { return statement_; }
    SQLite::Statement* operator->() { return &statement_; }

   private:
    SQLite::Statement& statement_;
  };

  // The database outlives this.
  explicit CompiledStatements(SQLite::Database& db) : db_(db) {}

  // Nobody else has the same SQL's statement in use.
  [[nodiscard]] Lease Take(std::string_view sql);

 private:
  SQLite::Database& db_;
  std::map<std::string, SQLite::Statement, std::less<>> statements_;
};

}  // namespace trailcast::store
