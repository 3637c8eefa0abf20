#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {

Result<std::vector<KeptLane>> NetworkStore::Lanes() {
  return database_->Guarded("reading narrow places", [&]() -> Result<std::vector<KeptLane>> {
    std::vector<KeptLane> lanes;
    auto parts = database_->compiled.Take(
        "SELECT lane, route, from_m, to_m FROM lane_part ORDER BY lane, number");
    while (parts->executeStep()) {
      const std::int64_t number = parts->getColumn(0).getInt64();
      if (lanes.empty() || lanes.back().number != number) lanes.push_back({.number = number});
      lanes.back().lane.parts.push_back({parts->getColumn(1).getString(),
                                         parts->getColumn(2).getDouble(),
                                         parts->getColumn(3).getDouble()});
    }
    auto holders = database_->compiled.Take("SELECT agent FROM lane_holder WHERE lane = ?1");
    for (KeptLane& lane : lanes) {
      holders->reset();
      holders->bind(1, lane.number);
      while (holders->executeStep()) lane.holders.emplace(holders->getColumn(0).getString());
    }
    return lanes;
  });
}

Result<std::int64_t> NetworkStore::Put(const network::Lane& lane, const std::string& by,
                                       std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing a narrow place", [&]() -> Result<std::int64_t> {
    const std::int64_t number =
        database_->Count("SELECT coalesce(max(lane), 0) + 1 FROM lane_part");
    for (const network::Part& part : lane.parts) {
      database_->Run(
          "INSERT INTO lane_part (lane, route, from_m, to_m, set_by, set_unix_ms) VALUES (?1, ?2, "
          "?3, ?4, ?5, ?6)",
          number, part.route, part.from_m, part.to_m, by, now_unix_ms);
    }
    if (database_->Count("SELECT count(*) FROM lane_part") > kMostLaneParts) {
      return Fail(ErrorCode::kUnavailable, "{} narrow places are kept already: no more",
                  kMostLaneParts);
    }
    return number;
  });
}

Result<void> NetworkStore::DropLane(std::int64_t number) {
  return database_->AllOrNothing("forgetting a narrow place", [&]() -> Result<void> {
    database_->Run("DELETE FROM lane_part WHERE lane = ?1", number);
    database_->Run("DELETE FROM lane_holder WHERE lane = ?1", number);
    return {};
  });
}

Result<void> NetworkStore::Hold(std::span<const std::int64_t> lanes, const AgentId& agent) {
  return database_->AllOrNothing("storing who has a narrow place", [&]() -> Result<void> {
    for (const std::int64_t lane : lanes) {
      database_->Run("INSERT OR IGNORE INTO lane_holder (lane, agent) VALUES (?1, ?2)", lane,
                     agent.value());
    }
    if (database_->Count("SELECT count(*) FROM lane_holder") > kMostHolders) {
      return Fail(ErrorCode::kUnavailable, "narrow places are taken {} times already: no more",
                  kMostHolders);
    }
    return {};
  });
}

Result<void> NetworkStore::Release(std::span<const std::int64_t> lanes, const AgentId& agent) {
  return database_->AllOrNothing("storing who has a narrow place", [&]() -> Result<void> {
    for (const std::int64_t lane : lanes) {
      database_->Run("DELETE FROM lane_holder WHERE lane = ?1 AND agent = ?2", lane, agent.value());
    }
    return {};
  });
}

}  // namespace trailcast::store
