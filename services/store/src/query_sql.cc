#include "services/store/src/query_sql.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "services/base/number.h"
#include "services/route/route_ref.h"

namespace trailcast::store {
namespace {

using route::RouteInfo;
using route::RouteOrder;
using route::RouteQuery;

// This comes after every character with which a name or a camera's begins.
constexpr const char* kAfterAnyText = "\xF4\x8F\xBF\xBF";
constexpr double kEarthRadius_m = 6371008.8;

// How an order sorts: by a column of `route`, then by key; the letter stands for it in cursors.
struct Sorting {
  RouteOrder order;
  char letter;
  const char* column;
  bool rising;
};
constexpr std::array kSortings = {Sorting{RouteOrder::kNewest, 'n', "taught_unix_ms", false},
                                  Sorting{RouteOrder::kOldest, 'o', "taught_unix_ms", true},
                                  Sorting{RouteOrder::kName, 'a', "name", true},
                                  Sorting{RouteOrder::kLongest, 'l', "length_m", false},
                                  Sorting{RouteOrder::kShortest, 's', "length_m", true}};

const Sorting& SortingOf(RouteOrder order) {
  const auto found = std::find_if(kSortings.begin(), kSortings.end(),
                                  [&](const Sorting& each) { return each.order == order; });
  return found == kSortings.end() ? kSortings.front() : *found;
}

std::vector<std::string_view> Split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

// Returns a cursor's value in the type of the column with which it is compared.
std::optional<SqlValue> ValueIn(RouteOrder order, std::string_view text) {
  if (order == RouteOrder::kName) return std::string(text);
  if (order == RouteOrder::kNewest || order == RouteOrder::kOldest) {
    if (const auto number = ParseNumber<std::int64_t>(text)) return *number;
  } else if (const auto metres = ParseNumber<double>(text)) {
    return *metres;
  }
  return std::nullopt;
}

// Places are found by a box, which is all that SQLite's tree of places knows, and a distance then
// cuts out the circle in it. On the globe a degree of longitude shortens towards the poles. This is
// right for surroundings that are small compared with the Earth and do not cross the 180th
// meridian.
void BeginsNear(const route::Surroundings& near, SqlDialect dialect, SqlCondition& condition) {
  const bool globe = near.middle.frame == route::Place::Frame::kWgs84;
  constexpr double kDegree_m = kEarthRadius_m * std::numbers::pi / 180.0;
  const double y_m = globe ? kDegree_m : 1.0;
  const double x_m =
      globe ? kDegree_m * std::max(0.01, std::cos(near.middle.y * std::numbers::pi / 180.0)) : 1.0;
  const double x = near.radius_m / x_m;
  const double y = near.radius_m / y_m;
  const auto frame = static_cast<std::int64_t>(near.middle.frame);
  const std::vector<SqlValue> box{frame, near.middle.x + x, near.middle.x - x, near.middle.y + y,
                                  near.middle.y - y};
  if (dialect == SqlDialect::kSqlite) {
    condition.FindBy(
        "route_place",
        "frame = ? AND east_low <= ? AND east_high >= ? AND north_low <= ? AND north_high >= ?",
        box);
  } else {
    condition.And(
        "place_frame = ? AND place_east <= ? AND place_east >= ? AND place_north <= ? AND "
        "place_north >= ?",
        box);
  }
  condition.And(
      "((place_east - ?) * ?) * ((place_east - ?) * ?) + "
      "((place_north - ?) * ?) * ((place_north - ?) * ?) <= ?",
      {near.middle.x, x_m, near.middle.x, x_m, near.middle.y, y_m, near.middle.y, y_m,
       near.radius_m * near.radius_m});
}

}  // namespace

void SqlCondition::And(const std::string& term, std::vector<SqlValue> values) {
  terms_.push_back(term);
  values_.insert(values_.end(), values.begin(), values.end());
}

void SqlCondition::FindBy(const std::string& table, const std::string& term,
                          std::vector<SqlValue> values) {
  found_by_ = table;
  And(term, std::move(values));
}

std::string SqlCondition::Where() const {
  return terms_.empty() ? "" : fmt::format(" WHERE {}", fmt::join(terms_, " AND "));
}

std::string SqlCondition::CountedFromWhere() const {
  const bool by_that_alone = !found_by_.empty() && terms_.size() == 1;
  return by_that_alone ? fmt::format(" FROM {}{}", found_by_, Where()) : FromWhere();
}

std::string SqlCondition::FromWhere() const {
  return fmt::format(" FROM {}{}",
                     found_by_.empty() ? "route" : found_by_ + " CROSS JOIN route USING (id)",
                     Where());
}

SqlCondition MatchOf(const RouteQuery& query, const std::string& by_tag, SqlDialect dialect) {
  SqlCondition match;
  const bool found_by_tag = !by_tag.empty() && !query.near;
  if (found_by_tag) match.FindBy("route_tag", "tag = ?", {by_tag});
  if (route::LooksLikeId(query.name)) {
    match.And("(name = ? OR (route >= ? AND route < ?))",
              {query.name, query.name, query.name + route::kAfterAnyIdDigit});
  } else if (!query.name.empty()) {
    match.And("name = ?", {query.name});
  }
  if (!query.name_prefix.empty()) {
    match.And("name >= ? AND name < ?", {query.name_prefix, query.name_prefix + kAfterAnyText});
  }
  for (const std::string& tag : query.tags) {
    if (found_by_tag && tag == by_tag) continue;
    match.And("route.id IN (SELECT id FROM route_tag WHERE tag = ?)", {tag});
  }
  if (!query.scout.empty()) match.And("scout = ?", {query.scout});
  if (!query.camera_prefix.empty()) {
    match.And("camera >= ? AND camera < ?",
              {query.camera_prefix, query.camera_prefix + kAfterAnyText});
  }
  if (query.min_length_m > 0.0) match.And("length_m >= ?", {query.min_length_m});
  if (query.max_length_m > 0.0) match.And("length_m <= ?", {query.max_length_m});
  if (query.taught_from_unix_ms != 0) {
    match.And("taught_unix_ms >= ?", {query.taught_from_unix_ms});
  }
  if (query.taught_until_unix_ms != 0) {
    match.And("taught_unix_ms < ?", {query.taught_until_unix_ms});
  }
  if (query.state) match.And("state = ?", {static_cast<std::int64_t>(*query.state)});
  if (query.standing) {
    match.And("standing = ?", {static_cast<std::int64_t>(*query.standing)});
  }
  if (query.near) BeginsNear(*query.near, dialect, match);
  return match;
}

Result<void> StartAfterCursor(const RouteQuery& query, SqlCondition& condition) {
  if (query.cursor.empty()) return {};
  const Sorting& sorting = SortingOf(query.order);
  const std::vector<std::string_view> parts = Split(query.cursor, '/');
  const bool ours = parts.size() == 4 && parts[0] == std::string_view(&sorting.letter, 1);
  const auto value = ours ? ValueIn(query.order, parts[1]) : std::nullopt;
  const auto teaching = ours ? ParseNumber<std::uint64_t>(parts[3]) : std::nullopt;
  if (!value || !teaching) {
    return Fail(ErrorCode::kInvalidArgument,
                "cursor is not that of a page in this order; ask for the first page without one");
  }
  condition.And(
      fmt::format("({}, route, teaching) {} (?, ?, ?)", sorting.column, sorting.rising ? ">" : "<"),
      {*value, std::string(parts[2]), static_cast<std::int64_t>(*teaching)});
  return {};
}

std::string OrderBy(RouteOrder order) {
  const Sorting& sorting = SortingOf(order);
  return fmt::format(" ORDER BY {0} {1}, route {1}, teaching {1}", sorting.column,
                     sorting.rising ? "ASC" : "DESC");
}

std::string CursorAfter(RouteOrder order, const RouteInfo& last) {
  const Sorting& sorting = SortingOf(order);
  std::string value;
  if (order == RouteOrder::kName) {
    value = last.name;
  } else if (order == RouteOrder::kNewest || order == RouteOrder::kOldest) {
    value = fmt::format("{}", last.taught_unix_ms);
  } else {
    value = fmt::format("{}", last.length_m);  // the shortest text that reads back the same
  }
  return fmt::format("{}/{}/{}/{}", sorting.letter, value, last.key.route.value(),
                     last.key.teaching.value());
}

}  // namespace trailcast::store
