#include "services/records/mission_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "services/base/process_name.h"
#include "services/mission/orders.h"
#include "services/records/src/own_file.h"

namespace trailcast::store {
namespace {

namespace fs = std::filesystem;

// `number` rises in the order of arrival. A mission is found by each route that its orders name.
constexpr OwnFile kMissionFile{.id = 0x5452434D,  // "TRCM"
                               .version = 2,
                               .tables = R"(
CREATE TABLE mission (
  number INTEGER PRIMARY KEY,
  agent TEXT NOT NULL,
  id TEXT NOT NULL,
  client TEXT NOT NULL,
  orders TEXT NOT NULL,
  valid_for_s INTEGER NOT NULL,
  goes_on INTEGER NOT NULL,
  sent_unix_ms INTEGER NOT NULL,
  change INTEGER NOT NULL,
  state INTEGER NOT NULL,
  task INTEGER NOT NULL,
  way INTEGER NOT NULL,
  waits_for INTEGER NOT NULL,
  detail TEXT NOT NULL,
  changed_unix_ms INTEGER NOT NULL,
  UNIQUE (agent, id)
) STRICT;
CREATE INDEX mission_unanswered ON mission (number) WHERE state = 0;
CREATE TABLE mission_route (
  number INTEGER NOT NULL,
  route TEXT NOT NULL,
  PRIMARY KEY (route, number)
) STRICT, WITHOUT ROWID;
CREATE TABLE command (
  number INTEGER PRIMARY KEY,
  client TEXT NOT NULL,
  drawn INTEGER NOT NULL,
  order_given INTEGER NOT NULL,
  whom INTEGER NOT NULL,
  name TEXT NOT NULL,
  reason TEXT NOT NULL,
  given_unix_ms INTEGER NOT NULL,
  UNIQUE (client, drawn)
) STRICT;
CREATE TABLE answer (
  client TEXT NOT NULL,
  drawn INTEGER NOT NULL,
  agent TEXT NOT NULL,
  refused INTEGER NOT NULL,
  detail TEXT NOT NULL,
  PRIMARY KEY (client, drawn, agent)
) STRICT, WITHOUT ROWID;
)",
                               .holds = "missions",
                               .called = "mission store",
                               .added = R"(
CREATE TABLE IF NOT EXISTS queue_hold (
  agent TEXT PRIMARY KEY,
  why TEXT NOT NULL,
  at_unix_ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS staying_hold (agent TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS schedule (
  name TEXT PRIMARY KEY,
  words TEXT NOT NULL,
  made_by TEXT NOT NULL,
  paused_by TEXT NOT NULL,
  looked_unix_ms INTEGER NOT NULL,
  last_unix_ms INTEGER NOT NULL,
  outcome TEXT NOT NULL
) STRICT, WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS schedule_sent (
  name TEXT NOT NULL,
  agent TEXT NOT NULL,
  mission TEXT NOT NULL,
  why TEXT NOT NULL,
  PRIMARY KEY (name, agent)
) STRICT, WITHOUT ROWID;
)"};

constexpr const char* kColumns =
    "agent, id, client, orders, valid_for_s, goes_on, sent_unix_ms, change, state, task, way, "
    "waits_for, detail, changed_unix_ms, number";
constexpr int kNumberColumn = 14;

mission::Record RecordIn(SQLite::Statement& row) {
  const auto small = [&](int column) {
    return static_cast<std::uint32_t>(row.getColumn(column).getInt64());
  };
  mission::Record record;
  record.mission = {.agent = AgentId(row.getColumn(0).getString()),
                    .id = row.getColumn(1).getString(),
                    .client = AgentId(row.getColumn(2).getString()),
                    .orders = row.getColumn(3).getString(),
                    .valid_for_s = small(4),
                    .goes_on = small(5) != 0};
  record.sent_unix_ms = row.getColumn(6).getInt64();
  record.last = {
      .agent = record.mission.agent,
      .mission = record.mission.id,
      .change = small(7),
      .state = static_cast<mission::State>(std::min<std::uint32_t>(small(8), mission::kStates - 1)),
      .task = small(9),
      .way = small(10),
      .waits_for = static_cast<mission::WaitsFor>(
          std::min(small(11), static_cast<std::uint32_t>(mission::WaitsFor::kPlace))),
      .detail = row.getColumn(12).getString()};
  record.changed_unix_ms = row.getColumn(13).getInt64();
  return record;
}

// Returns the number below which the page's missions are.
std::int64_t Before(const mission::Query& query) {
  const auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(query.before == 0 ? most : std::min(query.before, most));
}

MissionStore::Hold HoldIn(SQLite::Statement& row) {
  return {.agent = AgentId(row.getColumn(0).getString()),
          .why = row.getColumn(1).getString(),
          .unix_ms = row.getColumn(2).getInt64(),
          .stays = row.getColumn(3).getInt() != 0};
}

MissionStore::Schedule ScheduleIn(SQLite::Statement& row) {
  return {.name = row.getColumn(0).getString(),
          .words = row.getColumn(1).getString(),
          .by = row.getColumn(2).getString(),
          .paused_by = row.getColumn(3).getString(),
          .looked_unix_ms = row.getColumn(4).getInt64(),
          .last_unix_ms = row.getColumn(5).getInt64(),
          .outcome = row.getColumn(6).getString(),
          .sent = {}};
}

using NamedSent = std::pair<std::string, MissionStore::Schedule::Sent>;

NamedSent SentIn(SQLite::Statement& row) {
  return {row.getColumn(0).getString(),
          {.agent = AgentId(row.getColumn(1).getString()),
           .mission = row.getColumn(2).getString(),
           .why = row.getColumn(3).getString()}};
}

mission::GivenCommand CommandIn(SQLite::Statement& row) {
  return {.command = {.client = AgentId(row.getColumn(0).getString()),
                      .number = static_cast<std::uint64_t>(row.getColumn(1).getInt64()),
                      .order = static_cast<mission::NowOrder>(row.getColumn(2).getInt()),
                      .whom = static_cast<mission::NowWhom>(row.getColumn(3).getInt()),
                      .name = row.getColumn(4).getString(),
                      .reason = row.getColumn(5).getString()},
          .answers = {},
          .given_unix_ms = row.getColumn(6).getInt64()};
}

// Returns "2, 6, 7", a list for SQL.
std::string EndedStates() {
  std::string list;
  for (std::uint8_t state = 0; state < mission::kStates; ++state) {
    if (!mission::HasEnded(static_cast<mission::State>(state))) continue;
    list += (list.empty() ? "" : ", ") + std::to_string(state);
  }
  return list;
}

// Matches a row's client with the name in the parameter or with one of its processes. ProcessName
// adds "-p" and digits, so that "desk-p7" belongs to "desk", and "desk-pump" does not.
std::string IsOrIsOf(int parameter) {
  return fmt::format(
      "(client = ?{0} OR (client GLOB ?{0} || '-p[0-9]*' AND "
      "substr(client, length(?{0}) + 3) NOT GLOB '*[^0-9]*'))",
      parameter);
}

}  // namespace

struct MissionStore::Database : OwnDatabase {
  Database(const fs::path& file, std::int64_t most)
      : OwnDatabase(file, kMissionFile), since_thinned_(most), most_kept(most) {}

  std::optional<mission::Record> Get(const AgentId& agent, const std::string& id) {
    auto select = compiled.Take(std::string("SELECT ") + kColumns +
                                " FROM mission WHERE agent = ?1 AND id = ?2");
    select->bind(1, agent.value());
    select->bind(2, id);
    if (!select->executeStep()) return std::nullopt;
    return RecordIn(*select);
  }

  void Insert(const mission::Mission& mission, std::int64_t now_unix_ms) {
    Run("INSERT INTO mission (agent, id, client, orders, valid_for_s, goes_on, sent_unix_ms, "
        "change, state, task, way, waits_for, detail, changed_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, "
        "?6, ?7, 0, 0, 0, 1, 0, '', ?7)",
        mission.agent.value(), mission.id, mission.client.value(), mission.orders,
        static_cast<std::int64_t>(mission.valid_for_s), mission.goes_on, now_unix_ms);
    NameRoutes(db.getLastInsertRowid(), mission.orders);
  }

  Result<mission::Record> Add(const mission::Mission& mission, std::int64_t now_unix_ms) {
    if (auto known = Get(mission.agent, mission.id)) return *std::move(known);
    if (Count("SELECT count(*) FROM mission WHERE state = 0") >= kMostUnanswered) {
      return Fail(ErrorCode::kUnavailable, "{} missions wait for robots already", kMostUnanswered);
    }
    if (UnansweredOf(mission.client) >= kMostUnansweredOfClient) {
      return Fail(ErrorCode::kUnavailable,
                  "{} missions of '{}' wait for robots already, which is as many as one sender may "
                  "have: cancel some, or send it when robots have answered",
                  kMostUnansweredOfClient, mission.client.value());
    }
    Insert(mission, now_unix_ms);
    Thin();
    return Get(mission.agent, mission.id).value();
  }

  // A server's own report (0) counts until the robot's arrives.
  bool Change(const mission::Report& report, std::int64_t now_unix_ms) {
    const int changed = Run(
        "UPDATE mission SET change = ?3, state = ?4, task = ?5, way = ?6, waits_for = ?7, detail = "
        "?8, changed_unix_ms = ?9 WHERE agent = ?1 AND id = ?2 AND (change < ?3 OR (?3 = 0 AND "
        "change = 0 AND state = 0))",
        report.agent.value(), report.mission, static_cast<std::int64_t>(report.change),
        static_cast<int>(report.state), static_cast<std::int64_t>(report.task),
        static_cast<std::int64_t>(report.way), static_cast<int>(report.waits_for), report.detail,
        now_unix_ms);
    return changed > 0;
  }

  // A member's processes count together, because each `trailcast send` has a name of its own.
  std::int64_t UnansweredOf(const AgentId& client) {
    auto count = compiled.Take("SELECT count(*) FROM mission WHERE state = 0 AND " + IsOrIsOf(1));
    count->bind(1, WithoutProcess(client.value()));
    count->executeStep();
    return count->getColumn(0).getInt64();
  }

  void NameRoutes(std::int64_t number, const std::string& orders) {
    for (const std::string& route : mission::RoutesIn(orders)) {
      Run("INSERT OR IGNORE INTO mission_route (number, route) VALUES (?1, ?2)", number, route);
    }
  }

  std::vector<mission::NowAnswer> AnswersTo(const mission::NowCommand& command) {
    auto select = compiled.Take(
        "SELECT agent, refused, detail FROM answer WHERE client = ?1 AND drawn = ?2 ORDER BY agent "
        "LIMIT 64");
    select->bind(1, command.client.value());
    select->bind(2, static_cast<std::int64_t>(command.number));
    std::vector<mission::NowAnswer> answers;
    while (select->executeStep()) {
      answers.push_back({.agent = AgentId(select->getColumn(0).getString()),
                         .client = command.client,
                         .number = command.number,
                         .refused = select->getColumn(1).getInt() != 0,
                         .detail = select->getColumn(2).getString()});
    }
    return answers;
  }

  // It works only now and then, because finding the oldest costs time, and with the first change of
  // each run, because a run may be too short to reach the bound.
  void Thin() {
    if (++since_thinned_ <= most_kept / 100) return;
    since_thinned_ = 0;
    const std::string kept = std::to_string(most_kept);
    db.exec("DELETE FROM mission WHERE state IN (" + EndedStates() +
            ") AND number <= (SELECT max(number) FROM mission) - " + kept);
    db.exec("DELETE FROM mission_route WHERE number NOT IN (SELECT number FROM mission)");
    db.exec("DELETE FROM command WHERE number <= (SELECT max(number) FROM command) - " + kept);
    db.exec(
        "DELETE FROM answer WHERE NOT EXISTS (SELECT 1 FROM command WHERE command.client = "
        "answer.client AND command.drawn = answer.drawn)");
  }

  std::int64_t since_thinned_;
  std::int64_t most_kept;
};

MissionStore::MissionStore(std::unique_ptr<Database> database) : database_(std::move(database)) {}
MissionStore::~MissionStore() = default;

Result<std::unique_ptr<MissionStore>> MissionStore::Open(const fs::path& file,
                                                         std::int64_t most_kept) {
  using Opened = Result<std::unique_ptr<MissionStore>>;
  return OwnDatabase::Guard(file, kMissionFile, "opening it", [&]() -> Opened {
    return std::unique_ptr<MissionStore>(
        new MissionStore(std::make_unique<Database>(file, most_kept)));
  });
}

std::vector<Result<mission::Record>> MissionStore::Add(std::span<const mission::Mission> missions,
                                                       std::int64_t now_unix_ms) {
  using Stored = std::vector<Result<mission::Record>>;
  auto stored = database_->AllOrNothing("storing missions", [&]() -> Result<Stored> {
    Stored each;
    for (const mission::Mission& mission : missions) {
      each.push_back(database_->Add(mission, now_unix_ms));
    }
    return each;
  });
  if (stored) return *std::move(stored);
  return Stored(missions.size(), tl::unexpected(stored.error()));
}

Result<std::vector<mission::Record>> MissionStore::AddAll(
    std::span<const mission::Mission> missions, std::int64_t now_unix_ms) {
  using Stored = std::vector<mission::Record>;
  return database_->AllOrNothing("storing missions", [&]() -> Result<Stored> {
    Stored stored;
    for (const mission::Mission& mission : missions) {
      auto added = database_->Add(mission, now_unix_ms);
      if (!added) return tl::unexpected(added.error());
      stored.push_back(*std::move(added));
    }
    return stored;
  });
}

Result<void> MissionStore::Assign(const AgentId& group, const std::string& id,
                                  const AgentId& robot) {
  return database_->AllOrNothing("giving mission " + id + " to a robot", [&]() -> Result<void> {
    if (database_->Get(robot, id)) {
      return Fail(ErrorCode::kConflict, "'{}' has a mission {} already", robot.value(), id);
    }
    database_->Run("UPDATE mission SET agent = ?3 WHERE agent = ?1 AND id = ?2", group.value(), id,
                   robot.value());
    return {};
  });
}

Result<bool> MissionStore::Amend(const AgentId& agent, const std::string& id,
                                 const std::string& orders) {
  return database_->AllOrNothing("storing other orders of mission " + id, [&]() -> Result<bool> {
    auto update = database_->compiled.Take(
        "UPDATE mission SET orders = ?3 WHERE agent = ?1 AND id = ?2 RETURNING number");
    update->bind(1, agent.value());
    update->bind(2, id);
    update->bind(3, orders);
    if (!update->executeStep()) return false;
    const std::int64_t number = update->getColumn(0).getInt64();
    while (update->executeStep()) continue;
    database_->NameRoutes(number, orders);
    return true;
  });
}

Result<std::vector<bool>> MissionStore::Change(std::span<const mission::Report> reports,
                                               std::int64_t now_unix_ms) {
  using AreNews = std::vector<bool>;
  return database_->AllOrNothing("storing what became of missions", [&]() -> Result<AreNews> {
    AreNews are_news;
    for (const mission::Report& report : reports) {
      are_news.push_back(database_->Change(report, now_unix_ms));
    }
    return are_news;
  });
}

Result<std::vector<mission::Record>> MissionStore::Unanswered() {
  return database_->Read(
      "reading missions",
      std::string("SELECT ") + kColumns + " FROM mission WHERE state = 0 ORDER BY number",
      RecordIn);
}

Result<void> MissionStore::Put(const Hold& hold) {
  return database_->AllOrNothing("storing that a queue is held", [&]() -> Result<void> {
    database_->Run("INSERT OR REPLACE INTO queue_hold (agent, why, at_unix_ms) VALUES (?1, ?2, ?3)",
                   hold.agent.value(), hold.why, hold.unix_ms);
    database_->Run("DELETE FROM staying_hold WHERE agent = ?1", hold.agent.value());
    if (hold.stays) {
      database_->Run("INSERT INTO staying_hold (agent) VALUES (?1)", hold.agent.value());
    }
    return {};
  });
}

Result<void> MissionStore::ForgetHold(const AgentId& agent) {
  return database_->AllOrNothing("forgetting that a queue was held", [&]() -> Result<void> {
    database_->Run("DELETE FROM queue_hold WHERE agent = ?1", agent.value());
    database_->Run("DELETE FROM staying_hold WHERE agent = ?1", agent.value());
    return {};
  });
}

Result<std::vector<MissionStore::Hold>> MissionStore::Holds() {
  return database_->Read("reading which queues are held",
                         "SELECT agent, why, at_unix_ms, EXISTS (SELECT 1 FROM staying_hold WHERE "
                         "staying_hold.agent = queue_hold.agent) FROM queue_hold",
                         HoldIn);
}

Result<void> MissionStore::Put(const Schedule& schedule) {
  return database_->AllOrNothing("storing schedule " + schedule.name, [&]() -> Result<void> {
    database_->Run(
        "INSERT OR REPLACE INTO schedule (name, words, made_by, paused_by, looked_unix_ms, "
        "last_unix_ms, outcome) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
        schedule.name, schedule.words, schedule.by, schedule.paused_by, schedule.looked_unix_ms,
        schedule.last_unix_ms, schedule.outcome);
    database_->Run("DELETE FROM schedule_sent WHERE name = ?1", schedule.name);
    for (const Schedule::Sent& sent : schedule.sent) {
      database_->Run(
          "INSERT INTO schedule_sent (name, agent, mission, why) VALUES (?1, ?2, ?3, ?4)",
          schedule.name, sent.agent.value(), sent.mission, sent.why);
    }
    return {};
  });
}

Result<void> MissionStore::ForgetSchedule(const std::string& name) {
  return database_->AllOrNothing("removing schedule " + name, [&]() -> Result<void> {
    database_->Run("DELETE FROM schedule WHERE name = ?1", name);
    database_->Run("DELETE FROM schedule_sent WHERE name = ?1", name);
    return {};
  });
}

Result<std::vector<MissionStore::Schedule>> MissionStore::Schedules() {
  auto all = database_->Read("reading schedules",
                             "SELECT name, words, made_by, paused_by, looked_unix_ms, "
                             "last_unix_ms, outcome FROM schedule ORDER BY name",
                             ScheduleIn);
  const auto sent = database_->Read(
      "reading what schedules have sent",
      "SELECT name, agent, mission, why FROM schedule_sent ORDER BY name, agent", SentIn);
  if (!all) return all;
  if (!sent) return tl::unexpected(sent.error());
  for (const auto& entry : *sent) {
    const auto of = std::find_if(all->begin(), all->end(), [&](const Schedule& schedule) {
      return schedule.name == entry.first;
    });
    if (of != all->end()) of->sent.push_back(entry.second);
  }
  return all;
}

Result<std::optional<mission::Record>> MissionStore::Get(const AgentId& agent,
                                                         const std::string& id) {
  return database_->Guarded(
      "reading mission " + id,
      [&]() -> Result<std::optional<mission::Record>> { return database_->Get(agent, id); });
}

Result<MissionStore::Page> MissionStore::Find(const mission::Query& query) {
  return database_->Guarded("looking missions up", [&]() -> Result<Page> {
    auto select = database_->compiled.Take(
        std::string("SELECT ") + kColumns +
        " FROM mission WHERE number < ?1 AND (?2 = '' OR agent = ?2) AND (?3 = '' OR id = ?3) AND "
        "(?4 = '' OR " +
        IsOrIsOf(4) +
        ") AND (?5 = 0 OR (1 << state) & ?5) AND "
        "sent_unix_ms >= ?6 AND (?7 = 0 OR sent_unix_ms < ?7) AND (?8 = '' OR EXISTS (SELECT 1 "
        "FROM mission_route WHERE route = ?8 AND mission_route.number = mission.number)) ORDER BY "
        "number DESC LIMIT ?9");
    select->bind(1, Before(query));
    select->bind(2, query.agent);
    select->bind(3, query.id);
    select->bind(4, query.client);
    select->bind(5, static_cast<std::int64_t>(query.states));
    select->bind(6, query.from_unix_ms);
    select->bind(7, query.until_unix_ms);
    select->bind(8, query.route);
    select->bind(9, static_cast<std::int64_t>(query.page_size) + 1);
    Page page;
    std::uint64_t last_number = 0;
    while (select->executeStep()) {
      if (page.missions.size() == query.page_size) {
        page.next = last_number;
        break;
      }
      page.missions.push_back(RecordIn(*select));
      last_number = static_cast<std::uint64_t>(select->getColumn(kNumberColumn).getInt64());
    }
    return page;
  });
}

Result<void> MissionStore::Add(const mission::NowCommand& command, std::int64_t now_unix_ms) {
  return database_->AllOrNothing("storing a command", [&]() -> Result<void> {
    database_->Run(
        "INSERT OR IGNORE INTO command (client, drawn, order_given, whom, name, reason, "
        "given_unix_ms) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)",
        command.client.value(), static_cast<std::int64_t>(command.number),
        static_cast<int>(command.order), static_cast<int>(command.whom), command.name,
        command.reason, now_unix_ms);
    database_->Thin();
    return {};
  });
}

Result<void> MissionStore::Add(const mission::NowAnswer& answer) {
  return database_->Guarded("storing an answer", [&]() -> Result<void> {
    database_->Run(
        "INSERT OR IGNORE INTO answer (client, drawn, agent, refused, detail) SELECT ?1, ?2, ?3, "
        "?4, ?5 WHERE EXISTS (SELECT 1 FROM command WHERE client = ?1 AND drawn = ?2)",
        answer.client.value(), static_cast<std::int64_t>(answer.number), answer.agent.value(),
        answer.refused, answer.detail);
    return {};
  });
}

Result<MissionStore::CommandPage> MissionStore::FindCommands(const mission::Query& query) {
  return database_->Guarded("looking commands up", [&]() -> Result<CommandPage> {
    auto select = database_->compiled.Take(
        std::string(
            "SELECT client, drawn, order_given, whom, name, reason, given_unix_ms, number FROM "
            "command "
            "WHERE number < ?1 AND (?2 = '' OR (whom = 0 AND name = ?2) OR EXISTS (SELECT 1 FROM "
            "answer WHERE answer.client = command.client AND answer.drawn = command.drawn AND "
            "agent = "
            "?2)) AND (?3 = '' OR (whom = 1 AND name = ?3)) AND (?4 = '' OR ") +
        IsOrIsOf(4) +
        ") AND given_unix_ms >= ?5 AND (?6 = 0 OR given_unix_ms < ?6) ORDER BY number "
        "DESC LIMIT ?7");
    select->bind(1, Before(query));
    select->bind(2, query.agent);
    select->bind(3, query.route);
    select->bind(4, query.client);
    select->bind(5, query.from_unix_ms);
    select->bind(6, query.until_unix_ms);
    select->bind(7, static_cast<std::int64_t>(query.page_size) + 1);
    CommandPage page;
    std::uint64_t last_number = 0;
    while (select->executeStep()) {
      if (page.commands.size() == query.page_size) {
        page.next = last_number;
        break;
      }
      page.commands.push_back(CommandIn(*select));
      last_number = static_cast<std::uint64_t>(select->getColumn(7).getInt64());
    }
    for (mission::GivenCommand& given : page.commands) {
      given.answers = database_->AnswersTo(given.command);
    }
    return page;
  });
}

}  // namespace trailcast::store
