#include "services/records/network_store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <utility>

#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// `shared_by_routes` holds the metres that the routes of a joint that was found share.
constexpr OwnFile kNetworkFile{.id = 0x5452434E,  // "TRCN"
                               .version = 1,
                               .tables = R"(
CREATE TABLE joint (
  number INTEGER PRIMARY KEY,
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  both INTEGER NOT NULL,
  ahead_m REAL,
  left_m REAL,
  turn_rad REAL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL,
  UNIQUE (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE condition (
  number INTEGER PRIMARY KEY,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  closed INTEGER NOT NULL,
  speed REAL NOT NULL,
  cost REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE INDEX condition_route ON condition (route);
CREATE TABLE named_place (
  name TEXT PRIMARY KEY,
  route TEXT NOT NULL,
  along_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE proposed_joint (
  number INTEGER PRIMARY KEY,
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  both INTEGER NOT NULL,
  ahead_m REAL,
  left_m REAL,
  turn_rad REAL,
  confidence REAL NOT NULL,
  verdict INTEGER NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL,
  UNIQUE (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE searched (revision TEXT PRIMARY KEY) STRICT;
CREATE TABLE shared_by_routes (
  from_route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_route TEXT NOT NULL,
  to_m REAL NOT NULL,
  length_m REAL NOT NULL,
  PRIMARY KEY (from_route, from_m, to_route, to_m)
) STRICT;
CREATE TABLE lane_part (
  number INTEGER PRIMARY KEY,
  lane INTEGER NOT NULL,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
CREATE TABLE lane_holder (
  lane INTEGER NOT NULL,
  agent TEXT NOT NULL,
  PRIMARY KEY (lane, agent)
) STRICT;
CREATE TABLE followed_stretch (
  route TEXT NOT NULL,
  teaching INTEGER NOT NULL,
  number INTEGER NOT NULL,
  passed REAL NOT NULL,
  lost REAL NOT NULL,
  at_unix_ms INTEGER NOT NULL,
  PRIMARY KEY (route, teaching, number)
) STRICT;
CREATE TABLE backed_stretch (
  number INTEGER PRIMARY KEY,
  route TEXT NOT NULL,
  from_m REAL NOT NULL,
  to_m REAL NOT NULL,
  set_by TEXT NOT NULL,
  set_unix_ms INTEGER NOT NULL
) STRICT;
)",
                               .holds = "joints",
                               .called = "store of the network"};

network::Joint JointIn(SQLite::Statement& row) {
  network::Joint joint{.from = {row.getColumn(0).getString(), row.getColumn(1).getDouble()},
                       .to = {row.getColumn(2).getString(), row.getColumn(3).getDouble()},
                       .both = row.getColumn(4).getInt() != 0};
  if (!row.getColumn(5).isNull()) {
    joint.lie = {.ahead_m = row.getColumn(5).getDouble(),
                 .left_m = row.getColumn(6).getDouble(),
                 .turn_rad = row.getColumn(7).getDouble()};
  }
  return joint;
}

network::Condition ConditionIn(SQLite::Statement& row) {
  return {.route = row.getColumn(0).getString(),
          .from_m = row.getColumn(1).getDouble(),
          .to_m = row.getColumn(2).getDouble(),
          .closed = row.getColumn(3).getInt() != 0,
          .speed = row.getColumn(4).getDouble(),
          .cost = row.getColumn(5).getDouble()};
}

network::Condition BackedIn(SQLite::Statement& row) {
  return {.route = row.getColumn(0).getString(),
          .from_m = row.getColumn(1).getDouble(),
          .to_m = row.getColumn(2).getDouble(),
          .backed = true};
}

network::NamedPlace NamedPlaceIn(SQLite::Statement& row) {
  return {.name = row.getColumn(0).getString(),
          .place = {row.getColumn(1).getString(), row.getColumn(2).getDouble()}};
}

ProposedJoint ProposedIn(SQLite::Statement& row) {
  using Verdict = ProposedJoint::Verdict;
  const int verdict = row.getColumn(9).getInt();
  return {.proposal = {JointIn(row), row.getColumn(8).getDouble()},
          .verdict = verdict == 1   ? Verdict::kRefused
                     : verdict == 2 ? Verdict::kTaken
                                    : Verdict::kNone,
          .length_m = row.getColumn(10).getDouble()};
}

FollowedStretch FollowedIn(SQLite::Statement& row) {
  return {.key = {RouteId(row.getColumn(0).getString()),
                  TeachingId(static_cast<std::uint64_t>(row.getColumn(1).getInt64()))},
          .number = row.getColumn(2).getInt64(),
          .passed = row.getColumn(3).getDouble(),
          .lost = row.getColumn(4).getDouble(),
          .at_unix_ms = row.getColumn(5).getInt64()};
}

std::string TextIn(SQLite::Statement& row) { return row.getColumn(0).getString(); }

void BindPlaces(SQLite::Statement& statement, const network::Joint& joint) {
  statement.bind(1, joint.from.route);
  statement.bind(2, joint.from.along_m);
  statement.bind(3, joint.to.route);
  statement.bind(4, joint.to.along_m);
}

// All of it, as the first columns.
void BindJoint(SQLite::Statement& statement, const network::Joint& joint) {
  BindPlaces(statement, joint);
  statement.bind(5, joint.both ? 1 : 0);
  const network::Lie lie = joint.lie.value_or(network::Lie{});
  const double numbers[] = {lie.ahead_m, lie.left_m, lie.turn_rad};
  for (int i = 0; i < 3; ++i) {
    joint.lie ? statement.bind(6 + i, numbers[i]) : statement.bind(6 + i);
  }
}

}  // namespace

struct NetworkStore::Database : OwnDatabase {
  explicit Database(const fs::path& file) : OwnDatabase(file, kNetworkFile) {}

  template <typename Value>
  std::vector<Value> All(const char* sql, Value (*in)(SQLite::Statement&)) {
    auto select = compiled.Take(sql);
    std::vector<Value> all;
    while (select->executeStep()) all.push_back(in(*select));
    return all;
  }

  void Remove(const network::Joint& joint) {
    auto remove = compiled.Take(
        "DELETE FROM joint WHERE from_route = ?1 AND from_m = ?2 AND to_route = ?3 AND to_m = ?4");
    BindPlaces(*remove, joint);
    remove->exec();
  }

  Result<void> Insert(const network::Joint& joint, const std::string& by,
                      std::int64_t now_unix_ms) {
    Remove(joint);
    if (Count("SELECT count(*) FROM joint") >= kMostJoints) {
      return Fail(ErrorCode::kUnavailable, "{} joints are kept already: no more", kMostJoints);
    }
    auto insert = compiled.Take(
        "INSERT INTO joint (from_route, from_m, to_route, to_m, both, ahead_m, left_m, turn_rad, "
        "set_by, set_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)");
    BindJoint(*insert, joint);
    insert->bind(9, by);
    insert->bind(10, now_unix_ms);
    insert->exec();
    return {};
  }

  void Insert(const std::string& route, const network::Condition& condition, const std::string& by,
              std::int64_t now_unix_ms) {
    auto insert = compiled.Take(
        condition.backed
            ? "INSERT INTO backed_stretch (route, from_m, to_m, set_by, set_unix_ms) VALUES (?1, "
              "?2, ?3, ?4, ?5)"
            : "INSERT INTO condition (route, from_m, to_m, set_by, set_unix_ms, closed, speed, "
              "cost) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)");
    insert->bind(1, route);
    insert->bind(2, condition.from_m);
    insert->bind(3, condition.to_m);
    insert->bind(4, by);
    insert->bind(5, now_unix_ms);
    if (!condition.backed) {
      insert->bind(6, condition.closed ? 1 : 0);
      insert->bind(7, condition.speed);
      insert->bind(8, condition.cost);
    }
    insert->exec();
  }

  void Insert(const ProposedJoint& proposed, const std::string& by, std::int64_t now_unix_ms) {
    auto put = compiled.Take(
        "INSERT OR REPLACE INTO proposed_joint (from_route, from_m, to_route, to_m, both, ahead_m, "
        "left_m, turn_rad, confidence, verdict, set_by, set_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, "
        "?6, ?7, ?8, ?9, ?10, ?11, ?12)");
    BindJoint(*put, proposed.proposal.joint);
    put->bind(9, proposed.proposal.confidence);
    put->bind(10, static_cast<int>(proposed.verdict));
    put->bind(11, by);
    put->bind(12, now_unix_ms);
    put->exec();
    if (proposed.length_m <= 0.0) return;
    auto share = compiled.Take(
        "INSERT OR REPLACE INTO shared_by_routes (from_route, from_m, to_route, to_m, length_m) "
        "VALUES (?1, ?2, ?3, ?4, ?5)");
    BindPlaces(*share, proposed.proposal.joint);
    share->bind(5, proposed.length_m);
    share->exec();
  }
};

NetworkStore::NetworkStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
NetworkStore::~NetworkStore() = default;

Result<std::unique_ptr<NetworkStore>> NetworkStore::Open(const fs::path& file) {
  using Opened = Result<std::unique_ptr<NetworkStore>>;
  return OwnDatabase::Guard(file, kNetworkFile, "opening it", [&]() -> Opened {
    return std::unique_ptr<NetworkStore>(new NetworkStore(std::make_unique<Database>(file)));
  });
}

Result<std::vector<network::Joint>> NetworkStore::Joints() {
  return database_->Guarded("reading joints", [&]() -> Result<std::vector<network::Joint>> {
    return database_->All(
        "SELECT from_route, from_m, to_route, to_m, both, ahead_m, left_m, turn_rad FROM joint "
        "ORDER BY number",
        JointIn);
  });
}

Result<std::vector<network::Condition>> NetworkStore::Conditions() {
  return database_->Guarded("reading conditions", [&]() -> Result<std::vector<network::Condition>> {
    auto all = database_->All(
        "SELECT route, from_m, to_m, closed, speed, cost FROM condition ORDER BY number",
        ConditionIn);
    const auto backed =
        database_->All("SELECT route, from_m, to_m FROM backed_stretch ORDER BY number", BackedIn);
    all.insert(all.end(), backed.begin(), backed.end());
    return all;
  });
}

Result<std::vector<network::NamedPlace>> NetworkStore::Names() {
  return database_->Guarded("reading names", [&]() -> Result<std::vector<network::NamedPlace>> {
    return database_->All("SELECT name, route, along_m FROM named_place ORDER BY name",
                          NamedPlaceIn);
  });
}

Result<std::vector<ProposedJoint>> NetworkStore::Proposals() {
  return database_->Guarded("reading proposals", [&]() -> Result<std::vector<ProposedJoint>> {
    return database_->All(
        "SELECT from_route, from_m, to_route, to_m, both, ahead_m, left_m, turn_rad, confidence, "
        "verdict, coalesce(length_m, 0.0) FROM proposed_joint LEFT JOIN shared_by_routes USING "
        "(from_route, from_m, to_route, to_m) ORDER BY number",
        ProposedIn);
  });
}

Result<std::vector<std::string>> NetworkStore::Searched() {
  return database_->Guarded("reading proposals", [&]() -> Result<std::vector<std::string>> {
    return database_->All("SELECT revision FROM searched", TextIn);
  });
}

Result<void> NetworkStore::Put(const network::Joint& joint, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->Guarded("storing a joint", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    if (auto inserted = database_->Insert(joint, by, now_unix_ms); !inserted) return inserted;
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::Drop(const network::Joint& joint) {
  return database_->Guarded("forgetting a joint", [&]() -> Result<void> {
    database_->Remove(joint);
    return {};
  });
}

Result<void> NetworkStore::Replace(const std::string& route,
                                   const std::vector<network::Condition>& conditions,
                                   const std::string& by, std::int64_t now_unix_ms) {
  return database_->Guarded("storing conditions", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    std::int64_t kept = static_cast<std::int64_t>(conditions.size());
    for (const auto& [remove_sql, count_sql] :
         {std::pair("DELETE FROM condition WHERE route = ?1", "SELECT count(*) FROM condition"),
          std::pair("DELETE FROM backed_stretch WHERE route = ?1",
                    "SELECT count(*) FROM backed_stretch")}) {
      auto remove = database_->compiled.Take(remove_sql);
      remove->bind(1, route);
      remove->exec();
      kept += database_->Count(count_sql);
    }
    if (kept > kMostConditions) {
      return Fail(ErrorCode::kUnavailable, "{} closed stretches and limits are kept: no more",
                  kMostConditions);
    }
    for (const network::Condition& condition : conditions) {
      database_->Insert(route, condition, by, now_unix_ms);
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::Put(const network::NamedPlace& named, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->Guarded("storing a name", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    auto put = database_->compiled.Take(
        "INSERT OR REPLACE INTO named_place (name, route, along_m, set_by, set_unix_ms) VALUES "
        "(?1, ?2, ?3, ?4, ?5)");
    put->bind(1, named.name);
    put->bind(2, named.place.route);
    put->bind(3, named.place.along_m);
    put->bind(4, by);
    put->bind(5, now_unix_ms);
    put->exec();
    if (database_->Count("SELECT count(*) FROM named_place") > kMostNames) {
      return Fail(ErrorCode::kUnavailable, "{} places have names already: no more", kMostNames);
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::Forget(const std::string& name) {
  return database_->Guarded("forgetting a name", [&]() -> Result<void> {
    auto forget = database_->compiled.Take("DELETE FROM named_place WHERE name = ?1");
    forget->bind(1, name);
    forget->exec();
    return {};
  });
}

Result<void> NetworkStore::Put(std::span<const ProposedJoint> proposed, const std::string& by,
                               std::int64_t now_unix_ms) {
  return database_->Guarded("storing proposals", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const ProposedJoint& each : proposed) {
      database_->Insert(each, by, now_unix_ms);
      if (each.verdict != ProposedJoint::Verdict::kTaken) continue;
      auto joined = database_->Insert(each.proposal.joint, by, now_unix_ms);
      if (!joined) return joined;
    }
    if (database_->Count("SELECT count(*) FROM proposed_joint") > kMostProposals) {
      return Fail(ErrorCode::kUnavailable, "{} proposed joints are kept already: no more",
                  kMostProposals);
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::MarkSearched(std::span<const std::string> revisions) {
  return database_->Guarded("storing what was looked at", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const std::string& revision : revisions) {
      auto put = database_->compiled.Take("INSERT OR IGNORE INTO searched (revision) VALUES (?1)");
      put->bind(1, revision);
      put->exec();
    }
    transaction.commit();
    return {};
  });
}

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
  return database_->Guarded("storing a narrow place", [&]() -> Result<std::int64_t> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    const std::int64_t number =
        database_->Count("SELECT coalesce(max(lane), 0) + 1 FROM lane_part");
    for (const network::Part& part : lane.parts) {
      auto insert = database_->compiled.Take(
          "INSERT INTO lane_part (lane, route, from_m, to_m, set_by, set_unix_ms) VALUES (?1, ?2, "
          "?3, ?4, ?5, ?6)");
      insert->bind(1, number);
      insert->bind(2, part.route);
      insert->bind(3, part.from_m);
      insert->bind(4, part.to_m);
      insert->bind(5, by);
      insert->bind(6, now_unix_ms);
      insert->exec();
    }
    if (database_->Count("SELECT count(*) FROM lane_part") > kMostLaneParts) {
      return Fail(ErrorCode::kUnavailable, "{} narrow stretches are kept already: no more",
                  kMostLaneParts);
    }
    transaction.commit();
    return number;
  });
}

Result<void> NetworkStore::DropLane(std::int64_t number) {
  return database_->Guarded("forgetting a narrow place", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const char* sql :
         {"DELETE FROM lane_part WHERE lane = ?1", "DELETE FROM lane_holder WHERE lane = ?1"}) {
      auto remove = database_->compiled.Take(sql);
      remove->bind(1, number);
      remove->exec();
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::Hold(std::span<const std::int64_t> lanes, const AgentId& agent) {
  return database_->Guarded("storing who has a narrow place", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const std::int64_t lane : lanes) {
      auto put = database_->compiled.Take(
          "INSERT OR IGNORE INTO lane_holder (lane, agent) VALUES (?1, ?2)");
      put->bind(1, lane);
      put->bind(2, agent.value());
      put->exec();
    }
    if (database_->Count("SELECT count(*) FROM lane_holder") > kMostHolders) {
      return Fail(ErrorCode::kUnavailable, "narrow places are taken {} times already: no more",
                  kMostHolders);
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::Release(std::span<const std::int64_t> lanes, const AgentId& agent) {
  return database_->Guarded("storing who has a narrow place", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const std::int64_t lane : lanes) {
      auto remove =
          database_->compiled.Take("DELETE FROM lane_holder WHERE lane = ?1 AND agent = ?2");
      remove->bind(1, lane);
      remove->bind(2, agent.value());
      remove->exec();
    }
    transaction.commit();
    return {};
  });
}

Result<void> NetworkStore::DropProposals(const std::string& revision) {
  return database_->Guarded("forgetting proposals", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const char* sql : {"DELETE FROM proposed_joint WHERE from_route = ?1 OR to_route = ?1",
                            "DELETE FROM shared_by_routes WHERE from_route = ?1 OR to_route = ?1",
                            "DELETE FROM searched WHERE revision = ?1"}) {
      auto remove = database_->compiled.Take(sql);
      remove->bind(1, revision);
      remove->exec();
    }
    transaction.commit();
    return {};
  });
}

Result<std::vector<FollowedStretch>> NetworkStore::Followed() {
  return database_->Guarded(
      "reading how routes were followed", [&]() -> Result<std::vector<FollowedStretch>> {
        return database_->All(
            "SELECT route, teaching, number, passed, lost, at_unix_ms FROM followed_stretch ORDER "
            "BY at_unix_ms, rowid",
            FollowedIn);
      });
}

Result<void> NetworkStore::Put(std::span<const FollowedStretch> followed) {
  return database_->Guarded("storing how routes were followed", [&]() -> Result<void> {
    SQLite::Transaction transaction(database_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const FollowedStretch& each : followed) {
      auto put = database_->compiled.Take(
          "INSERT OR REPLACE INTO followed_stretch (route, teaching, number, passed, lost, "
          "at_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, ?6)");
      put->bind(1, each.key.route.value());
      put->bind(2, static_cast<std::int64_t>(each.key.teaching.value()));
      put->bind(3, each.number);
      put->bind(4, each.passed);
      put->bind(5, each.lost);
      put->bind(6, each.at_unix_ms);
      put->exec();
    }
    if (database_->Count("SELECT count(*) FROM followed_stretch") > kMostFollowed) {
      auto forget = database_->compiled.Take(
          "DELETE FROM followed_stretch WHERE rowid IN (SELECT rowid FROM followed_stretch "
          "ORDER BY at_unix_ms DESC, rowid DESC LIMIT -1 OFFSET ?1)");
      forget->bind(1, kMostFollowed);
      forget->exec();
    }
    transaction.commit();
    return {};
  });
}

}  // namespace trailcast::store
