#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

network::Condition ConditionIn(SQLite::Statement& row) {
  return {.route = row.getColumn(0).getString(),
          .from_m = row.getColumn(1).getDouble(),
          .to_m = row.getColumn(2).getDouble(),
          .closed = row.getColumn(3).getInt() != 0,
          .backed = row.getColumn(4).getInt() != 0,
          .speed = row.getColumn(5).getDouble(),
          .cost = row.getColumn(6).getDouble()};
}

void InsertCondition(OwnDatabase& database, const std::string& route,
                     const network::Condition& condition, const std::string& by,
                     std::int64_t now_unix_ms) {
  if (condition.backed) {
    database.Run(
        "INSERT INTO backed_stretch (route, from_m, to_m, set_by, set_unix_ms) VALUES (?1, ?2, ?3, "
        "?4, ?5)",
        route, condition.from_m, condition.to_m, by, now_unix_ms);
  } else {
    database.Run(
        "INSERT INTO condition (route, from_m, to_m, set_by, set_unix_ms, closed, speed, cost) "
        "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
        route, condition.from_m, condition.to_m, by, now_unix_ms, condition.closed, condition.speed,
        condition.cost);
  }
}

}  // namespace

Result<std::vector<network::Condition>> NetworkStore::Conditions() {
  return database_->Read("reading conditions",
                         "SELECT route, from_m, to_m, closed, 0 AS backed, speed, cost, number "
                         "FROM condition UNION ALL SELECT route, from_m, to_m, 0, 1, 1.0, 1.0, "
                         "number FROM backed_stretch ORDER BY backed, number",
                         ConditionIn);
}

Result<void> NetworkStore::Replace(const std::string& route,
                                   const std::vector<network::Condition>& conditions,
                                   const std::string& by, std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing conditions", [&]() -> Result<void> {
    database_->Run("DELETE FROM condition WHERE route = ?1", route);
    database_->Run("DELETE FROM backed_stretch WHERE route = ?1", route);
    const std::int64_t others = database_->Count(
        "SELECT (SELECT count(*) FROM condition) + (SELECT count(*) FROM backed_stretch)");
    if (others + static_cast<std::int64_t>(conditions.size()) > kMostConditions) {
      return Fail(ErrorCode::kUnavailable, "{} closed sections and limits are kept: no more",
                  kMostConditions);
    }
    for (const network::Condition& condition : conditions) {
      InsertCondition(*database_, route, condition, by, now_unix_ms);
    }
    return {};
  });
}

}  // namespace trailcast::store
