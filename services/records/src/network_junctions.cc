#include "services/records/network_store.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

network::Junction JunctionIn(SQLite::Statement& row) {
  network::Junction junction{.from = {row.getColumn(0).getString(), row.getColumn(1).getDouble()},
                             .to = {row.getColumn(2).getString(), row.getColumn(3).getDouble()},
                             .both = row.getColumn(4).getInt() != 0};
  if (!row.getColumn(5).isNull()) {
    junction.lie = {.ahead_m = row.getColumn(5).getDouble(),
                    .left_m = row.getColumn(6).getDouble(),
                    .turn_rad = row.getColumn(7).getDouble()};
  }
  return junction;
}

ProposedJunction ProposedIn(SQLite::Statement& row) {
  using Verdict = ProposedJunction::Verdict;
  const int verdict = row.getColumn(9).getInt();
  return {.proposal = {JunctionIn(row), row.getColumn(8).getDouble()},
          .verdict = verdict == 1   ? Verdict::kRefused
                     : verdict == 2 ? Verdict::kTaken
                                    : Verdict::kNone,
          .length_m = row.getColumn(10).getDouble()};
}

std::string TextIn(SQLite::Statement& row) { return row.getColumn(0).getString(); }

// The first parameters are the junction's places; the others follow.
template <typename... Values>
void RunAt(OwnDatabase& database, const char* sql, const network::Junction& junction,
           const Values&... values) {
  database.Run(sql, junction.from.route, junction.from.along_m, junction.to.route,
               junction.to.along_m, values...);
}

// The first parameters are the whole junction.
template <typename... Values>
void RunWith(OwnDatabase& database, const char* sql, const network::Junction& junction,
             const Values&... values) {
  const auto lie = [&](double network::Lie::*part) {
    return junction.lie ? std::optional((*junction.lie).*part) : std::nullopt;
  };
  RunAt(database, sql, junction, junction.both, lie(&network::Lie::ahead_m),
        lie(&network::Lie::left_m), lie(&network::Lie::turn_rad), values...);
}

void RemoveJunction(OwnDatabase& database, const network::Junction& junction) {
  RunAt(database,
        "DELETE FROM joint WHERE from_route = ?1 AND from_m = ?2 AND to_route = ?3 AND to_m = ?4",
        junction);
}

Result<void> InsertJunction(OwnDatabase& database, const network::Junction& junction,
                            const std::string& by, std::int64_t now_unix_ms) {
  RemoveJunction(database, junction);
  if (database.Count("SELECT count(*) FROM joint") >= NetworkStore::kMostJunctions) {
    return Fail(ErrorCode::kUnavailable, "{} junctions are kept already: no more",
                NetworkStore::kMostJunctions);
  }
  RunWith(database,
          "INSERT INTO joint (from_route, from_m, to_route, to_m, both, ahead_m, left_m, turn_rad, "
          "set_by, set_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)",
          junction, by, now_unix_ms);
  return {};
}

Result<void> InsertProposed(OwnDatabase& database, const ProposedJunction& proposed,
                            const std::string& by, std::int64_t now_unix_ms) {
  const network::Junction& junction = proposed.proposal.junction;
  RunWith(database,
          "INSERT OR REPLACE INTO proposed_joint (from_route, from_m, to_route, to_m, both, "
          "ahead_m, left_m, turn_rad, confidence, verdict, set_by, set_unix_ms) VALUES (?1, ?2, "
          "?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12)",
          junction, proposed.proposal.confidence, static_cast<int>(proposed.verdict), by,
          now_unix_ms);
  if (proposed.length_m > 0.0) {
    RunAt(database,
          "INSERT OR REPLACE INTO shared_by_routes (from_route, from_m, to_route, to_m, length_m) "
          "VALUES (?1, ?2, ?3, ?4, ?5)",
          junction, proposed.length_m);
  }
  if (proposed.verdict != ProposedJunction::Verdict::kTaken) return {};
  return InsertJunction(database, junction, by, now_unix_ms);
}

}  // namespace

Result<std::vector<network::Junction>> NetworkStore::Junctions() {
  return database_->Read("reading junctions",
                         "SELECT from_route, from_m, to_route, to_m, both, ahead_m, left_m, "
                         "turn_rad FROM joint ORDER BY number",
                         JunctionIn);
}

Result<void> NetworkStore::Put(const network::Junction& junction, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing a junction", [&]() -> Result<void> {
    return InsertJunction(*database_, junction, by, now_unix_ms);
  });
}

Result<void> NetworkStore::Drop(const network::Junction& junction) {
  return database_->Guarded("forgetting a junction", [&]() -> Result<void> {
    RemoveJunction(*database_, junction);
    return {};
  });
}

Result<std::vector<ProposedJunction>> NetworkStore::Proposals() {
  return database_->Read(
      "reading proposals",
      "SELECT from_route, from_m, to_route, to_m, both, ahead_m, left_m, turn_rad, confidence, "
      "verdict, coalesce(length_m, 0.0) FROM proposed_joint LEFT JOIN shared_by_routes USING "
      "(from_route, from_m, to_route, to_m) ORDER BY number",
      ProposedIn);
}

Result<void> NetworkStore::Put(std::span<const ProposedJunction> proposed, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing proposals", [&]() -> Result<void> {
    for (const ProposedJunction& each : proposed) {
      if (auto put = InsertProposed(*database_, each, by, now_unix_ms); !put) return put;
    }
    if (database_->Count("SELECT count(*) FROM proposed_joint") > kMostProposals) {
      return Fail(ErrorCode::kUnavailable, "{} proposed junctions are kept already: no more",
                  kMostProposals);
    }
    return {};
  });
}

Result<void> NetworkStore::DropProposals(const std::string& revision) {
  return database_->AllOrNothing("forgetting proposals", [&]() -> Result<void> {
    for (const char* sql : {"DELETE FROM proposed_joint WHERE from_route = ?1 OR to_route = ?1",
                            "DELETE FROM shared_by_routes WHERE from_route = ?1 OR to_route = ?1",
                            "DELETE FROM searched WHERE revision = ?1"}) {
      database_->Run(sql, revision);
    }
    return {};
  });
}

Result<std::vector<std::string>> NetworkStore::Searched() {
  return database_->Read("reading proposals", "SELECT revision FROM searched", TextIn);
}

Result<void> NetworkStore::MarkSearched(std::span<const std::string> revisions) {
  return database_->AllOrNothing("storing what was looked at", [&]() -> Result<void> {
    for (const std::string& revision : revisions) {
      database_->Run("INSERT OR IGNORE INTO searched (revision) VALUES (?1)", revision);
    }
    return {};
  });
}

}  // namespace trailcast::store
