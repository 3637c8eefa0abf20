#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

FollowedSection FollowedIn(SQLite::Statement& row) {
  return {.key = {RouteId(row.getColumn(0).getString()),
                  TeachingId(static_cast<std::uint64_t>(row.getColumn(1).getInt64()))},
          .number = row.getColumn(2).getInt64(),
          .passed = row.getColumn(3).getDouble(),
          .lost = row.getColumn(4).getDouble(),
          .at_unix_ms = row.getColumn(5).getInt64()};
}

}  // namespace

Result<std::vector<FollowedSection>> NetworkStore::Followed() {
  return database_->Read("reading how routes were followed",
                         "SELECT route, teaching, number, passed, lost, at_unix_ms FROM "
                         "followed_stretch ORDER BY at_unix_ms, rowid",
                         FollowedIn);
}

Result<void> NetworkStore::Put(std::span<const FollowedSection> followed) {
  return database_->AllOrNothing("storing how routes were followed", [&]() -> Result<void> {
    for (const FollowedSection& each : followed) {
      database_->Run(
          "INSERT OR REPLACE INTO followed_stretch (route, teaching, number, passed, lost, "
          "at_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
          each.key.route.value(), static_cast<std::int64_t>(each.key.teaching.value()), each.number,
          each.passed, each.lost, each.at_unix_ms);
    }
    if (database_->Count("SELECT count(*) FROM followed_stretch") > kMostFollowed) {
      database_->Run(
          "DELETE FROM followed_stretch WHERE rowid IN (SELECT rowid FROM followed_stretch "
          "ORDER BY at_unix_ms DESC, rowid DESC LIMIT -1 OFFSET ?1)",
          kMostFollowed);
    }
    return {};
  });
}

}  // namespace trailcast::store
