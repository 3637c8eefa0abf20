#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "services/base/result.h"
#include "services/route/route_query.h"

namespace trailcast::store {

// A condition in SQL with the values of its question marks, in their order.
class SqlCondition {
 public:
  using Value = std::variant<std::string, std::int64_t, double>;

  void And(const std::string& term, std::vector<Value> values = {});
  [[nodiscard]] std::string Where() const { return terms_.empty() ? "" : " WHERE " + terms_; }
  // From parameter 1 on; the number of the next one.
  int Bind(SQLite::Statement& statement) const;

 private:
  std::string terms_;
  std::vector<Value> values_;
};

// What a row of table `route` must fulfil; the page asked for does not matter here.
[[nodiscard]] SqlCondition MatchOf(const route::RouteQuery& query);
// Adds that a row comes after the query's cursor. kInvalidArgument for one that is none of ours.
[[nodiscard]] Result<void> StartAfterCursor(const route::RouteQuery& query,
                                            SqlCondition& condition);
[[nodiscard]] std::string OrderBy(route::RouteOrder order);
// The cursor of the page after this row.
[[nodiscard]] std::string CursorAfter(route::RouteOrder order, const route::RouteInfo& last);

}  // namespace trailcast::store
