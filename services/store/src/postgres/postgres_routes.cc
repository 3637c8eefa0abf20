// This part of PostgresRouteStore stores routes' descriptions, and finds routes.
#include <algorithm>

#include "services/base/unix_time.h"
#include "services/route/labels.h"
#include "services/store/src/postgres/postgres_rows.h"
#include "services/store/src/postgres/postgres_store.h"
#include "services/store/src/query_sql.h"

namespace trailcast::store {
namespace {

using route::RouteInfo;
using route::RouteKey;
using route::RoutePage;
using route::RouteQuery;
using Transaction = pqxx::transaction_base;
using Infos = std::map<RouteKey, RouteInfo>;

constexpr std::size_t kColumns = kRouteColumnCount + 1;  // grown_unix_ms
constexpr const char* kNewestFirst = "ORDER BY taught_unix_ms DESC, route DESC, teaching DESC";

std::string SelectFrom(const std::string& table) {
  return fmt::format("SELECT {} FROM {} ", kRouteColumns, table);
}

// Returns "route = excluded.route, teaching = excluded.teaching, ..".
std::string AllFromExcluded() {
  std::string assignments;
  std::string columns = kRouteColumns;
  columns += ", ";
  for (std::size_t at = 0; at < columns.size();) {
    const std::size_t end = columns.find(", ", at);
    const std::string column = columns.substr(at, end - at);
    assignments += fmt::format("{}{} = excluded.{}", at == 0 ? "" : ", ", column, column);
    at = end + 2;
  }
  return assignments;
}

// Returns the known revisions, including tombstones, without those whose row is damaged.
Infos FindKnown(Transaction& transaction, const std::set<RouteKey>& keys) {
  Infos known;
  ForSome(keys, [&](auto begin, auto end) {
    PostgresValues values;
    std::for_each(begin, end, [&](const RouteKey& key) { values.Add(key); });
    const std::string where = "WHERE (route, teaching) IN (" + values.Rows(2) + ") ";
    const pqxx::result rows = values.Execute(
        transaction, SelectFrom("route") + where + "UNION ALL " + SelectFrom("tombstone") + where);
    for (const pqxx::row& row : rows) {
      if (auto info = ReadRoute(row)) known.emplace(info->key, std::move(*info));
    }
  });
  return known;
}

using Some = Infos::const_iterator;

pqxx::result PutRows(Transaction& transaction, const std::string& table, Some begin, Some end) {
  PostgresValues values;
  const std::int64_t now_unix_ms = NowUnixMs();
  for (Some each = begin; each != end; ++each) {
    values.AddRoute(each->second);
    values.Add(now_unix_ms);
  }
  return values.Execute(
      transaction,
      fmt::format("INSERT INTO {0} ({1}, grown_unix_ms) VALUES {2} "
                  "ON CONFLICT (route, teaching) DO UPDATE SET {3}, grown_unix_ms = CASE "
                  "WHEN {0}.segment_count = excluded.segment_count AND {0}.state = excluded.state "
                  "THEN {0}.grown_unix_ms ELSE excluded.grown_unix_ms END "
                  "RETURNING route, teaching, id",
                  table, kRouteColumns, values.Rows(kColumns), AllFromExcluded()));
}

void ReplaceTags(Transaction& transaction, const pqxx::result& rows, const Infos& infos) {
  PostgresValues ids;
  PostgresValues tags;
  for (const pqxx::row& row : rows) {
    const auto id = row[2].as<std::int64_t>();
    ids.Add(id);
    for (const std::string& tag : infos.at(ReadKey(row)).tags) {
      tags.Add(tag);
      tags.Add(id);
    }
  }
  (void)ids.Execute(transaction, "DELETE FROM route_tag WHERE id IN (" + ids.Rows(1) + ")");
  if (tags.empty()) return;
  (void)tags.Execute(transaction, "INSERT INTO route_tag (tag, id) VALUES " + tags.Rows(2));
}

void PutLiving(Transaction& transaction, const Infos& infos) {
  ForSome(infos, [&](Some begin, Some end) {
    ReplaceTags(transaction, PutRows(transaction, "route", begin, end), infos);
  });
}

// Contents that no other revision has are deleted as well.
void DeleteSegments(Transaction& transaction, const PostgresValues& keys) {
  (void)keys.Execute(transaction,
                     "DELETE FROM receipt WHERE (route, teaching) IN (" + keys.Rows(2) + ")");
  const pqxx::result digests =
      keys.Execute(transaction, "DELETE FROM segment WHERE (route, teaching) IN (" + keys.Rows(2) +
                                    ") RETURNING digest");
  ForSome(digests, [&](auto begin, auto end) {
    PostgresValues values;
    for (auto each = begin; each != end; ++each) {
      const pqxx::binarystring digest((*each)[0]);
      values.AddBytes(digest.data(), digest.size());
    }
    (void)values.Execute(transaction,
                         "DELETE FROM content WHERE digest IN (" + values.Rows(1) +
                             ") AND NOT EXISTS (SELECT FROM segment WHERE segment.digest = "
                             "content.digest)");
  });
}

void Bury(Transaction& transaction, const Infos& infos) {
  ForSome(infos, [&](Some begin, Some end) {
    PostgresValues keys;
    for (Some each = begin; each != end; ++each) keys.Add(each->first);
    (void)keys.Execute(transaction,
                       "DELETE FROM route WHERE (route, teaching) IN (" + keys.Rows(2) + ")");
    DeleteSegments(transaction, keys);
    (void)PutRows(transaction, "tombstone", begin, end);
  });
}

}  // namespace

Result<void> PostgresRouteStore::PutRoutes(std::span<const RouteInfo> infos) {
  for (const RouteInfo& info : infos) {
    if (Result<void> possible = CheckRoute(info); !possible) return possible;
  }
  if (infos.empty()) return {};
  return session_->Run(
      Kind::kWrite,
      fmt::format("storing {} routes, {} first", infos.size(), Describe(infos.front().key)),
      [&](Transaction& transaction) { return Put(transaction, infos); });
}

Result<void> PostgresRouteStore::DropSegments(const RouteKey& key) {
  return session_->Run(Kind::kWrite, "dropping the segments of " + Describe(key),
                       [&](Transaction& transaction) -> Result<void> {
                         Lock(transaction, {key});
                         PostgresValues values;
                         values.Add(key);
                         DeleteSegments(transaction, values);
                         return {};
                       });
}

Result<void> PostgresRouteStore::Put(Transaction& transaction, std::span<const RouteInfo> infos) {
  Keys keys;
  for (const RouteInfo& info : infos) keys.insert(info.key);
  Lock(transaction, keys);
  const Infos before = FindKnown(transaction, keys);
  Infos after = before;
  for (const RouteInfo& info : infos) {
    const auto [at, is_first] = after.try_emplace(info.key, info);
    if (is_first) continue;
    Result<RouteInfo> merged = route::AfterNews(at->second, info);
    if (!merged) return Wrap(merged.error(), "route store " + session_->name());
    at->second = std::move(*merged);
  }
  Infos living;
  Infos buried;
  for (auto& [key, info] : after) {
    if (const auto known = before.find(key); known != before.end() && known->second == info) {
      continue;
    }
    (info.standing == route::Standing::kDeleted ? buried : living).emplace(key, std::move(info));
  }
  PutLiving(transaction, living);
  Bury(transaction, buried);
  return {};
}

Result<std::vector<RouteInfo>> PostgresRouteStore::ReadRoutes(const pqxx::result& rows) const {
  std::vector<RouteInfo> routes;
  for (const pqxx::row& row : rows) {
    Result<RouteInfo> info = ReadRoute(row);
    if (!info) return Wrap(info.error(), "route store " + session_->name());
    routes.push_back(std::move(*info));
  }
  return routes;
}

Result<std::vector<RouteInfo>> PostgresRouteStore::SelectRoutes(const PostgresValues& values,
                                                                const std::string& sql) {
  return session_->Run(Kind::kRead, "looking up routes", [&](Transaction& transaction) {
    return ReadRoutes(values.Execute(transaction, sql));
  });
}

Result<std::optional<RouteInfo>> PostgresRouteStore::FindRoute(const RouteKey& key) {
  PostgresValues values;
  values.Add(key);
  const std::string where = "WHERE route = $1 AND teaching = $2 ";
  auto found = SelectRoutes(
      values, SelectFrom("route") + where + "UNION ALL " + SelectFrom("tombstone") + where);
  if (!found) return tl::unexpected(found.error());
  if (found->empty()) return std::nullopt;
  return std::move(found->front());
}

Result<std::vector<RouteInfo>> PostgresRouteStore::FindRevisions(const RouteId& route) {
  PostgresValues values;
  values.Add(route.value());
  return SelectRoutes(values, SelectFrom("route") + "WHERE route = ? ORDER BY revision, teaching");
}

Result<std::vector<KnownTeaching>> PostgresRouteStore::FindTeachings(const RouteId& route) {
  return session_->Run(
      Kind::kRead, "listing the teachings of a route",
      [&](Transaction& transaction) -> Result<std::vector<KnownTeaching>> {
        PostgresValues values;
        values.Add(route.value());
        std::vector<KnownTeaching> known;
        for (const pqxx::row& row : values.Execute(
                 transaction,
                 "SELECT teaching, revision, grown_unix_ms FROM route WHERE route = $1 UNION ALL "
                 "SELECT teaching, revision, grown_unix_ms FROM tombstone WHERE route = $1")) {
          known.push_back({TeachingId(row[0].as<std::uint64_t>()),
                           RevisionNumber(row[1].as<std::uint32_t>()), row[2].as<std::int64_t>()});
        }
        return known;
      });
}

Result<std::vector<RouteInfo>> PostgresRouteStore::FindRoutesWithin(const std::string& id_prefix) {
  return session_->Run(
      Kind::kRead, "looking up routes by id",
      [&](Transaction& transaction) -> Result<std::vector<RouteInfo>> {
        PostgresValues values;
        values.Add(id_prefix);
        values.Add(id_prefix + kAfterHexDigits);
        const std::string where = "WHERE route >= $1 AND route < $2 ";
        std::vector<RouteInfo> found;
        for (const pqxx::row& row : values.Execute(
                 transaction, SelectFrom("route") + where + "UNION ALL " + SelectFrom("tombstone") +
                                  where + "ORDER BY route, teaching")) {
          if (auto info = ReadRoute(row)) found.push_back(std::move(*info));
        }
        return found;
      });
}

Result<std::vector<RouteInfo>> PostgresRouteStore::ListRoutes() {
  return SelectRoutes({}, SelectFrom("route") + kNewestFirst);
}

Result<std::vector<RouteInfo>> PostgresRouteStore::FindRoutesByName(const std::string& name) {
  PostgresValues values;
  values.Add(name);
  return SelectRoutes(values, SelectFrom("route") + "WHERE name = ? " + kNewestFirst);
}

Result<RoutePage> PostgresRouteStore::QueryRoutes(const RouteQuery& query) {
  const SqlCondition all = MatchOf(query, "", SqlDialect::kPostgres);
  SqlCondition rest = all;
  if (auto started = StartAfterCursor(query, rest); !started) {
    return tl::unexpected(started.error());
  }
  const std::size_t wanted = query.page_size == 0 ? kMaxPage : std::min(query.page_size, kMaxPage);
  PostgresValues values;
  values.Add(rest.values());
  values.Add(static_cast<std::int64_t>(wanted + 1));  // one more shows whether there is another
                                                      // page
  auto found = SelectRoutes(values, fmt::format("SELECT {}{}{} LIMIT ?", kRouteColumns,
                                                rest.FromWhere(), OrderBy(query.order)));
  if (!found) return tl::unexpected(found.error());
  RoutePage page;
  page.routes = std::move(*found);
  page.total = page.routes.size();
  if (page.routes.size() > wanted) {
    page.routes.pop_back();
    page.next = CursorAfter(query.order, page.routes.back());
  }
  if (page.next.empty() && query.cursor.empty()) return page;
  const auto total = session_->Run(
      Kind::kRead, "counting routes", [&](Transaction& transaction) -> Result<std::uint64_t> {
        PostgresValues matching;
        matching.Add(all.values());
        return matching.Execute(transaction, "SELECT count(*)" + all.FromWhere())[0][0]
            .as<std::uint64_t>();
      });
  if (!total) return tl::unexpected(total.error());
  page.total = *total;
  return page;
}

Result<std::vector<std::string>> PostgresRouteStore::NamesNear(const std::string& name,
                                                               std::size_t count) {
  return session_->Run(
      Kind::kRead, "listing names",
      [&](Transaction& transaction) -> Result<std::vector<std::string>> {
        std::vector<std::string> names;
        for (const char* side : {">= ? ORDER BY name ASC", "< ? ORDER BY name DESC"}) {
          PostgresValues values;
          values.Add(name);
          values.Add(static_cast<std::int64_t>(count));
          for (const pqxx::row& row : values.Execute(
                   transaction,
                   fmt::format("SELECT DISTINCT name FROM route WHERE name {} LIMIT ?", side))) {
            names.push_back(row[0].as<std::string>());
          }
        }
        return names;
      });
}

}  // namespace trailcast::store
