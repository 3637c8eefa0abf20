// This part of SqliteRouteStore finds routes.
#include <algorithm>

#include "services/base/unix_time.h"
#include "services/store/sqlite_store.h"
#include "services/store/src/query_sql.h"
#include "services/store/src/rows.h"

namespace trailcast::store {
namespace {

using route::RouteInfo;
using route::RoutePage;
using route::RouteQuery;

// Bytes on which other revisions' segments rely go to the first of those.
constexpr const char* kBequeath = R"(
WITH leaving AS (
  SELECT digest, bytes FROM segment WHERE route = ?1 AND teaching = ?2 AND bytes IS NOT NULL)
UPDATE segment AS heir SET bytes = (SELECT bytes FROM leaving WHERE digest = heir.digest)
WHERE substr(digest, 1, 4) IN (SELECT substr(digest, 1, 4) FROM leaving)
  AND digest IN (SELECT digest FROM leaving) AND NOT (route = ?1 AND teaching = ?2)
  AND rowid = (SELECT MIN(rowid) FROM segment WHERE substr(digest, 1, 4) = substr(heir.digest, 1, 4)
               AND digest = heir.digest AND NOT (route = ?1 AND teaching = ?2)) AND bytes IS NULL
)";

// It jumps from one key to the next.
constexpr const char* kNextHeld = R"(
SELECT route, teaching,
  (SELECT COUNT(*) FROM segment WHERE route = next.route AND teaching = next.teaching),
  EXISTS (SELECT 1 FROM route WHERE route = next.route AND teaching = next.teaching)
FROM (SELECT route, teaching FROM segment WHERE (route, teaching) > (?1, ?2)
      ORDER BY route, teaching LIMIT 1) AS next
)";

void BindSize(SQLite::Statement& statement, int parameter, std::size_t size) {
  statement.bind(parameter, static_cast<std::int64_t>(size));
}

}  // namespace

std::int64_t SqliteRouteStore::PutRow(const std::string& table, const RouteInfo& info) {
  auto put = compiled_.Take(
      fmt::format("INSERT OR REPLACE INTO {0} ({1}, id, grown_unix_ms) VALUES ({2},"
                  "(SELECT id FROM {0} WHERE route = ?1 AND teaching = ?2),"
                  "coalesce((SELECT grown_unix_ms FROM {0} WHERE route = ?1 AND "
                  "teaching = ?2 AND state = ?8 AND segment_count = ?9), ?{3}))",
                  table, kRouteColumns, Marks(kRouteColumnCount), kRouteColumnCount + 1));
  BindRoute(*put, info);
  put->bind(kRouteColumnCount + 1, NowUnixMs());
  put->exec();
  return db_->getLastInsertRowid();
}

void SqliteRouteStore::ForgetPlaceAndTags(std::int64_t id) {
  for (const char* table : {"route_tag", "route_place"}) {
    auto forget = compiled_.Take(fmt::format("DELETE FROM {} WHERE id = ?", table));
    forget->bind(1, id);
    forget->exec();
  }
}

void SqliteRouteStore::Bury(const RouteInfo& info) {
  auto find = compiled_.Take("SELECT id FROM route WHERE route = ? AND teaching = ?");
  BindKey(*find, info.key);
  if (find->executeStep()) ForgetPlaceAndTags(find->getColumn(0).getInt64());
  find->reset();
  PartWith(info.key);
  auto forget = compiled_.Take("DELETE FROM route WHERE route = ? AND teaching = ?");
  BindKey(*forget, info.key);
  forget->exec();
  PutRow("tombstone", info);
}

void SqliteRouteStore::PartWith(const route::RouteKey& key) {
  for (const char* parting : {kBequeath, "DELETE FROM segment WHERE route = ? AND teaching = ?",
                              "DELETE FROM receipt WHERE route = ? AND teaching = ?"}) {
    auto part = compiled_.Take(parting);
    BindKey(*part, key);
    part->exec();
  }
}

Result<void> SqliteRouteStore::DropSegments(const route::RouteKey& key) {
  return Guarded("dropping the segments of " + Describe(key), [&]() -> Result<void> {
    SQLite::Transaction transaction(*db_, SQLite::TransactionBehavior::IMMEDIATE);
    PartWith(key);
    transaction.commit();
    return {};
  });
}

Result<std::vector<HeldTeaching>> SqliteRouteStore::ListHeld(const route::RouteKey& after,
                                                             std::size_t most) {
  return Guarded(
      "listing the teachings of which it has segments", [&]() -> Result<std::vector<HeldTeaching>> {
        std::vector<HeldTeaching> held;
        route::RouteKey last = after;
        while (held.size() < most) {
          auto next = compiled_.Take(kNextHeld);
          BindKey(*next, last);
          if (!next->executeStep()) break;
          last = {RouteId(next->getColumn(0).getString()), TeachingOf(next->getColumn(1))};
          const auto segments = static_cast<std::uint64_t>(next->getColumn(2).getInt64());
          held.push_back({last, segments, next->getColumn(3).getInt() != 0});
        }
        return held;
      });
}

void SqliteRouteStore::Put(const RouteInfo& info) {
  const std::int64_t id = PutRow("route", info);
  ForgetPlaceAndTags(id);
  for (const std::string& tag : info.tags) {
    auto add = compiled_.Take("INSERT INTO route_tag (tag, id) VALUES (?, ?)");
    add->bind(1, tag);
    add->bind(2, id);
    add->exec();
  }
  if (!info.place) return;
  const auto frame = static_cast<int>(info.place->frame);
  auto add = compiled_.Take("INSERT INTO route_place VALUES (?1, ?2, ?2, ?3, ?3, ?4)");
  add->bind(1, id);
  add->bind(2, info.place->x);
  add->bind(3, info.place->y);
  add->bind(4, frame);
  add->exec();
}

// If many routes have a tag, the first page is found fastest in the requested order; if few have
// it, by sorting those few.
std::string SqliteRouteStore::RareTag(const RouteQuery& query) {
  constexpr int kFew = 5000;
  for (const std::string& tag : query.tags) {
    SQLite::Statement select(*db_, "SELECT 1 FROM route_tag WHERE tag = ? LIMIT 1 OFFSET ?");
    select.bind(1, tag);
    select.bind(2, kFew);
    if (!select.executeStep()) return tag;
  }
  return "";
}

Result<RoutePage> SqliteRouteStore::QueryRoutes(const RouteQuery& query) {
  return Guarded("searching routes", [&]() -> Result<RoutePage> {
    SqlCondition match = MatchOf(query, RareTag(query));
    if (auto started = StartAfterCursor(query, match); !started) {
      return tl::unexpected(started.error());
    }
    const std::size_t wanted =
        query.page_size == 0 ? kMaxPage : std::min(query.page_size, kMaxPage);
    SQLite::Statement select(*db_, fmt::format("SELECT {}{}{} LIMIT ?", kRouteColumns,
                                               match.FromWhere(), OrderBy(query.order)));
    const int limit = BindValues(select, match.values());
    BindSize(select, limit, wanted + 1);  // one more shows whether there is another page
    RoutePage page;
    while (select.executeStep()) {
      if (page.routes.size() == wanted) {
        page.next = CursorAfter(query.order, page.routes.back());
        break;
      }
      Result<RouteInfo> info = ReadRoute(select);
      if (!info) return Wrap(info.error(), "route store " + file_.path().string());
      page.routes.push_back(std::move(*info));
    }
    page.total = page.routes.size();
    if (page.next.empty() && query.cursor.empty()) return page;
    // Counting sorts nothing, however many routes have the tag.
    const SqlCondition all = MatchOf(query, query.tags.empty() ? "" : query.tags.front());
    SQLite::Statement count(*db_, "SELECT COUNT(*)" + all.CountedFromWhere());
    BindValues(count, all.values());
    count.executeStep();
    page.total = static_cast<std::uint64_t>(count.getColumn(0).getInt64());
    return page;
  });
}

Result<std::vector<std::string>> SqliteRouteStore::NamesNear(const std::string& name,
                                                             std::size_t count) {
  return Guarded("listing names", [&]() -> Result<std::vector<std::string>> {
    std::vector<std::string> names;
    for (const char* side : {">= ? ORDER BY name ASC", "< ? ORDER BY name DESC"}) {
      SQLite::Statement select(
          *db_, fmt::format("SELECT DISTINCT name FROM route WHERE name {} LIMIT ?", side));
      select.bind(1, name);
      BindSize(select, 2, count);
      while (select.executeStep()) names.push_back(select.getColumn(0).getString());
    }
    return names;
  });
}

}  // namespace trailcast::store
