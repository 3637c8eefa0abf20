#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

network::NamedPlace NamedPlaceIn(SQLite::Statement& row) {
  return {.name = row.getColumn(0).getString(),
          .place = {row.getColumn(1).getString(), row.getColumn(2).getDouble()},
          .home = row.getColumn(3).getInt() != 0};
}

}  // namespace

Result<std::vector<network::NamedPlace>> NetworkStore::Names() {
  return database_->Read("reading names",
                         "SELECT name, route, along_m, EXISTS (SELECT 1 FROM home WHERE home.name "
                         "= named_place.name) FROM named_place ORDER BY name",
                         NamedPlaceIn);
}

Result<void> NetworkStore::Put(const network::NamedPlace& named, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing a name", [&]() -> Result<void> {
    database_->Run(
        "INSERT OR REPLACE INTO named_place (name, route, along_m, set_by, set_unix_ms) VALUES "
        "(?1, ?2, ?3, ?4, ?5)",
        named.name, named.place.route, named.place.along_m, by, now_unix_ms);
    database_->Run("DELETE FROM home WHERE name = ?1", named.name);
    if (named.home) database_->Run("INSERT INTO home (name) VALUES (?1)", named.name);
    if (database_->Count("SELECT count(*) FROM named_place") > kMostNames) {
      return Fail(ErrorCode::kUnavailable, "{} places have names already: no more", kMostNames);
    }
    return {};
  });
}

Result<void> NetworkStore::Forget(const std::string& name) {
  return database_->AllOrNothing("forgetting a name", [&]() -> Result<void> {
    database_->Run("DELETE FROM named_place WHERE name = ?1", name);
    database_->Run("DELETE FROM home WHERE name = ?1", name);
    return {};
  });
}

}  // namespace trailcast::store
