// This is SqliteRouteStore::Verify, which reads everything in the store once and reports damage
// line by line.
#include "services/store/sqlite_store.h"
#include "services/store/src/rows.h"
#include "services/store/src/verify.h"

namespace trailcast::store {
namespace {

constexpr int kMaxPageLines = 20;

}  // namespace

Result<std::vector<std::string>> SqliteRouteStore::Verify() {
  std::vector<std::string> damage;
  for (auto part : {&SqliteRouteStore::VerifyPages, &SqliteRouteStore::VerifyRoutes}) {
    const Result<void> done = (this->*part)(damage);
    if (done) continue;
    if (done.error().code != ErrorCode::kCorrupt) return tl::unexpected(done.error());
    damage.push_back(done.error().message);
  }
  return damage;
}

Result<void> SqliteRouteStore::VerifyPages(std::vector<std::string>& damage) {
  return Guarded("checking its pages", [&]() -> Result<void> {
    SQLite::Statement check(*db_, fmt::format("PRAGMA integrity_check({})", kMaxPageLines));
    while (check.executeStep()) {
      const std::string line = check.getColumn(0).getString();
      if (line != "ok") damage.push_back("route store " + file_.path().string() + ": " + line);
    }
    return {};
  });
}

Result<void> SqliteRouteStore::VerifyRoutes(std::vector<std::string>& damage) {
  std::vector<route::RouteKey> keys;
  Result<void> listed = Guarded("listing what it holds", [&]() -> Result<void> {
    SQLite::Statement select(*db_,
                             "SELECT route, teaching FROM route UNION "
                             "SELECT route, teaching FROM tombstone UNION "
                             "SELECT route, teaching FROM segment ORDER BY 1, 2");
    while (select.executeStep()) {
      keys.push_back({RouteId(select.getColumn(0).getString()), TeachingOf(select.getColumn(1))});
    }
    return {};
  });
  if (!listed) return listed;
  for (const route::RouteKey& key : keys) {
    Result<void> verified = VerifyRevision(*this, file_.path().string(), key, damage);
    if (verified) continue;
    if (verified.error().code != ErrorCode::kCorrupt) return verified;
    damage.push_back(verified.error().message);
  }
  return {};
}

}  // namespace trailcast::store
