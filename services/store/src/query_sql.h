#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_query.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {

// SQLite is told how to find rows (by the places' R-tree, by a rare tag); PostgreSQL's planner
// finds its own way, by its statistics, and keeps a place in the route's row.
enum class SqlDialect : std::uint8_t { kSqlite, kPostgres };

// Which rows of table `route`: FROM and WHERE in SQL with the values of the question marks, in
// their order.
class SqlCondition {
 public:
  void And(const std::string& term, std::vector<SqlValue> values = {});
  // Rows are found by this table of ids and then looked up, however
  // they are to be sorted: right where it narrows down much.
  void FindBy(const std::string& table, const std::string& term, std::vector<SqlValue> values);
  [[nodiscard]] std::string FromWhere() const;
  // The same for counting alone, which looks up no more than it must.
  [[nodiscard]] std::string CountedFromWhere() const;
  [[nodiscard]] const std::vector<SqlValue>& values() const { return values_; }

 private:
  [[nodiscard]] std::string Where() const;

  std::string found_by_;
  std::vector<std::string> terms_;
  std::vector<SqlValue> values_;
};

// What a row of table `route` must fulfil; the page asked for does not matter here. `by_tag`: the
// one of the query's tags by which rows are to be found; empty: none, as when many routes have it.
[[nodiscard]] SqlCondition MatchOf(const route::RouteQuery& query, const std::string& by_tag,
                                   SqlDialect dialect = SqlDialect::kSqlite);
// Adds that a row comes after the query's cursor. kInvalidArgument for one that is none of ours.
[[nodiscard]] Result<void> StartAfterCursor(const route::RouteQuery& query,
                                            SqlCondition& condition);
[[nodiscard]] std::string OrderBy(route::RouteOrder order);
// The cursor of the page after this row.
[[nodiscard]] std::string CursorAfter(route::RouteOrder order, const route::RouteInfo& last);

}  // namespace trailcast::store
