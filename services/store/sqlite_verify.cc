// SqliteRouteStore::Verify: everything in the store read once, and what is wrong said line by line.
#include "services/route/digest.h"
#include "services/store/rows.h"
#include "services/store/sqlite_store.h"

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
                             "SELECT route, revision FROM route UNION "
                             "SELECT route, revision FROM tombstone UNION "
                             "SELECT route, revision FROM segment ORDER BY 1, 2");
    while (select.executeStep()) {
      keys.push_back({RouteId(select.getColumn(0).getString()),
                      RevisionNumber(select.getColumn(1).getUInt())});
    }
    return {};
  });
  if (!listed) return listed;
  for (const route::RouteKey& key : keys) {
    Result<void> verified = VerifyRoute(key, damage);
    if (verified) continue;
    if (verified.error().code != ErrorCode::kCorrupt) return verified;
    damage.push_back(verified.error().message);
  }
  return {};
}

Result<void> SqliteRouteStore::VerifyRoute(const route::RouteKey& key,
                                           std::vector<std::string>& damage) {
  const Result<std::vector<SegmentIndex>> held = HeldSegments(key);
  if (!held) return tl::unexpected(held.error());
  std::vector<route::Digest> digests;
  for (const SegmentIndex index : *held) {
    const Result<route::SegmentPiece> piece = ReadSegment(key, index);
    if (piece) {
      if (index.value() == digests.size()) digests.push_back(piece->digest);
    } else if (piece.error().code == ErrorCode::kUnavailable) {
      return tl::unexpected(piece.error());
    } else {
      damage.push_back(piece.error().message);
    }
  }
  const Result<std::optional<route::RouteInfo>> info = FindRoute(key);
  if (!info) return tl::unexpected(info.error());
  const bool living = info->has_value() && (*info)->standing != route::Standing::kDeleted;
  if (living && (*info)->state == route::RouteState::kComplete &&
      digests.size() == (*info)->segment_count &&
      route::ManifestDigest(digests) != (*info)->manifest_digest) {
    damage.push_back(
        fmt::format("route store {}: {} (named '{}'): its {} segments are each whole but not those "
                    "its scout announced",
                    file_.path().string(), Describe(key), (*info)->name, digests.size()));
  }
  return {};
}

}  // namespace trailcast::store
