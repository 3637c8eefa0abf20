#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

network::NamedPlace NamedPlaceIn(SQLite::Statement& row) {
  return {.name = row.getColumn(0).getString(),
          .place = {row.getColumn(1).getString(), row.getColumn(2).getDouble()},
          .home = row.getColumn(3).getInt() != 0,
          .dock = row.getColumn(4).getInt() != 0};
}

std::pair<std::string, AgentId> DockHolderIn(SQLite::Statement& row) {
  return {row.getColumn(0).getString(), AgentId(row.getColumn(1).getString())};
}

network::ChargeLimits ChargeIn(SQLite::Statement& row) {
  return {.below_percent = row.getColumn(0).getInt(), .until_percent = row.getColumn(1).getInt()};
}

void ForgetKinds(OwnDatabase& database, const std::string& name) {
  database.Run("DELETE FROM home WHERE name = ?1", name);
  database.Run("DELETE FROM dock WHERE name = ?1", name);
}

}  // namespace

Result<std::vector<network::NamedPlace>> NetworkStore::Names() {
  return database_->Read("reading names",
                         "SELECT name, route, along_m, EXISTS (SELECT 1 FROM home WHERE home.name "
                         "= named_place.name), EXISTS (SELECT 1 FROM dock WHERE dock.name = "
                         "named_place.name) FROM named_place ORDER BY name",
                         NamedPlaceIn);
}

Result<void> NetworkStore::Put(const network::NamedPlace& named, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing a name", [&]() -> Result<void> {
    database_->Run(
        "INSERT OR REPLACE INTO named_place (name, route, along_m, set_by, set_unix_ms) VALUES "
        "(?1, ?2, ?3, ?4, ?5)",
        named.name, named.place.route, named.place.along_m, by, now_unix_ms);
    ForgetKinds(*database_, named.name);
    if (named.home) database_->Run("INSERT INTO home (name) VALUES (?1)", named.name);
    if (named.dock) database_->Run("INSERT INTO dock (name) VALUES (?1)", named.name);
    if (database_->Count("SELECT count(*) FROM named_place") > kMostNames) {
      return Fail(ErrorCode::kUnavailable, "{} places have names already: no more", kMostNames);
    }
    return {};
  });
}

Result<void> NetworkStore::Forget(const std::string& name) {
  return database_->AllOrNothing("forgetting a name", [&]() -> Result<void> {
    database_->Run("DELETE FROM named_place WHERE name = ?1", name);
    ForgetKinds(*database_, name);
    database_->Run("DELETE FROM dock_holder WHERE dock = ?1", name);
    return {};
  });
}

Result<std::map<std::string, std::set<AgentId>>> NetworkStore::DockHolders() {
  const auto rows = database_->Read("reading who is at docks",
                                    "SELECT dock, agent FROM dock_holder", DockHolderIn);
  if (!rows) return tl::unexpected(rows.error());
  std::map<std::string, std::set<AgentId>> holders;
  for (const auto& [dock, agent] : *rows) holders[dock].insert(agent);
  return holders;
}

Result<void> NetworkStore::HoldDock(const std::string& name, const std::set<AgentId>& holders) {
  return database_->AllOrNothing("storing who is at a dock", [&]() -> Result<void> {
    database_->Run("DELETE FROM dock_holder WHERE dock = ?1", name);
    for (const AgentId& agent : holders) {
      database_->Run("INSERT INTO dock_holder (dock, agent) VALUES (?1, ?2)", name, agent.value());
    }
    return {};
  });
}

Result<std::optional<network::ChargeLimits>> NetworkStore::Charge() {
  const auto rows = database_->Read("reading when robots charge",
                                    "SELECT below_percent, until_percent FROM charge", ChargeIn);
  if (!rows) return tl::unexpected(rows.error());
  return rows->empty() ? std::nullopt : std::optional(rows->front());
}

Result<void> NetworkStore::Put(const std::optional<network::ChargeLimits>& charge) {
  return database_->AllOrNothing("storing when robots charge", [&]() -> Result<void> {
    database_->Run("DELETE FROM charge");
    if (charge) {
      database_->Run("INSERT INTO charge (below_percent, until_percent) VALUES (?1, ?2)",
                     charge->below_percent, charge->until_percent);
    }
    return {};
  });
}

}  // namespace trailcast::store
