#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_query.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// SQLite is told how to find rows (by the places' R-tree, by a rare tag). PostgreSQL's planner
// finds its own way by its statistics, and has a place in the route's row.
enum class SqlDialect : std::uint8_t { kSqlite, kPostgres };

// Selects rows of table `route`: FROM and WHERE in SQL, with the values of the question marks in
// their order.
class SqlCondition {
 public:
  void And(const std::string& term, std::vector<SqlValue> values = {});
  // Finds rows by this table of ids and then looks them up, whatever their order. This is right if
  // the table narrows them down much.
  void FindBy(const std::string& table, const std::string& term, std::vector<SqlValue> values);
  [[nodiscard]] std::string FromWhere() const;
  // Returns the same for counting alone, which looks up no more than it must.
  [[nodiscard]] std::string CountedFromWhere() const;
  [[nodiscard]] const std::vector<SqlValue>& values() const { return values_; }

 private:
  [[nodiscard]] std::string Where() const;

  std::string found_by_;
  std::vector<std::string> terms_;
  std::vector<SqlValue> values_;
};

// Returns what a row of table `route` must fulfil, without the page. `by_tag` is the one of the
// query's tags by which rows are found; it is empty if many routes have the tag.
[[nodiscard]] SqlCondition MatchOf(const route::RouteQuery& query, const std::string& by_tag,
                                   SqlDialect dialect = SqlDialect::kSqlite);
// Adds that a row comes after the query's cursor. kInvalidArgument means that the cursor is none of
// ours.
[[nodiscard]] Result<void> StartAfterCursor(const route::RouteQuery& query,
                                            SqlCondition& condition);
[[nodiscard]] std::string OrderBy(route::RouteOrder order);
// Returns the cursor of the page after this row.
[[nodiscard]] std::string CursorAfter(route::RouteOrder order, const route::RouteInfo& last);

}  // namespace trailcast::store
