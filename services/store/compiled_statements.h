#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace trailcast::store {

// Keeps compiled SQLite statements that are needed for every segment or route, because compiling
// takes longer than answering. All are kept, so it is not for SQL that is built from a query.
class CompiledStatements {
 public:
  // A statement in use. Its destructor lets go of rows that were not read.
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

  // The database must outlive this.
  explicit CompiledStatements(SQLite::Database& db) : db_(db) {}

  // Only one lease of the same SQL may exist at a time.
  [[nodiscard]] Lease Take(std::string_view sql);

 private:
  SQLite::Database& db_;
  std::map<std::string, SQLite::Statement, std::less<>> statements_;
};

}  // namespace trailcast::store
