#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/mission/mission.h"
#include "services/mission/now.h"

namespace trailcast::store {

// Keeps missions, schedules and commands, and what became of them, in a SQLite file of its own,
// created if missing. A call's data is on the disk when it returns. Errors name the file:
// kUnavailable (disk full, no such folder), kConflict (another process has it open), kCorrupt (not
// our file, or a damaged one).
class MissionStore {
 public:
  // The oldest ended missions and the oldest commands are deleted once there are one per cent more
  // than `most_kept`.
  static constexpr std::int64_t kMostKept = 100'000;
  static constexpr std::int64_t kMostUnanswered = 10'000;
  // so that no client shuts out the others
  static constexpr std::int64_t kMostUnansweredOfClient = 1000;
  [[nodiscard]] static Result<std::unique_ptr<MissionStore>> Open(
      const std::filesystem::path& file, std::int64_t most_kept = kMostKept);
  ~MissionStore();
  MissionStore(const MissionStore&) = delete;
  MissionStore& operator=(const MissionStore&) = delete;

  // Adds missions in one commit. Times are milliseconds since 1970 by the caller's clock. A mission
  // that exists (agent and id) stays as it is. Returns what is stored of each. kUnavailable means
  // that too many missions wait, in all or of that client.
  [[nodiscard]] std::vector<Result<mission::Record>> Add(std::span<const mission::Mission> missions,
                                                         std::int64_t now_unix_ms);
  // Adds all of them or none.
  [[nodiscard]] Result<std::vector<mission::Record>> AddAll(
      std::span<const mission::Mission> missions, std::int64_t now_unix_ms);
  // Gives a mission of a group to a robot. Fails with kConflict if the robot has one of that id.
  [[nodiscard]] Result<void> Assign(const AgentId& group, const std::string& id,
                                    const AgentId& robot);
  // Changes missions in one commit. Returns false for a report that is no news (Report::change) or
  // whose mission is not there.
  [[nodiscard]] Result<std::vector<bool>> Change(std::span<const mission::Report> reports,
                                                 std::int64_t now_unix_ms);

  // Gives a mission other orders; returns false if it is not there.
  [[nodiscard]] Result<bool> Amend(const AgentId& agent, const std::string& id,
                                   const std::string& orders);

  // Returns the missions that no robot has answered and no server has dropped, the oldest first.
  [[nodiscard]] Result<std::vector<mission::Record>> Unanswered();

  // A robot's queue of missions is held, for a reason, or was let go, which is without one.
  struct Hold {
    AgentId agent{};
    std::string why{};
    std::int64_t unix_ms = 0;  // when it was held or let go
    bool stays = false;        // also while no mission waits
    bool operator==(const Hold&) const = default;
  };
  [[nodiscard]] Result<void> Put(const Hold& hold);
  [[nodiscard]] Result<void> ForgetHold(const AgentId& agent);
  [[nodiscard]] Result<std::vector<Hold>> Holds();

  // A mission that is sent at times, in words (schedule/schedule.h), and what became of the last
  // time that it was due.
  struct Schedule {
    struct Sent {
      AgentId agent{};
      std::string mission{};  // the last that was sent; empty if none was
      std::string why{};      // why none was sent the last time; empty if one was
      bool operator==(const Sent&) const = default;
    };
    std::string name{};
    std::string words{};
    std::string by{};
    std::string paused_by{};          // empty if it is not paused
    std::int64_t looked_unix_ms = 0;  // until then its times have been seen to
    std::int64_t last_unix_ms = 0;    // when it was due last; 0 if it never was
    std::string outcome{};            // why nobody was sent then
    std::vector<Sent> sent{};         // by agent
    bool operator==(const Schedule&) const = default;
  };
  // Adds a schedule, or changes the one of that name.
  [[nodiscard]] Result<void> Put(const Schedule& schedule);
  [[nodiscard]] Result<void> ForgetSchedule(const std::string& name);
  [[nodiscard]] Result<std::vector<Schedule>> Schedules();  // by name

  [[nodiscard]] Result<std::optional<mission::Record>> Get(const AgentId& agent,
                                                           const std::string& id);

  struct Page {
    std::vector<mission::Record> missions{};  // the newest first
    std::uint64_t next = 0;  // mission::Query::before for the next page; 0 after the last
  };
  [[nodiscard]] Result<Page> Find(const mission::Query& query);

  // Adds a command or an answer. One that exists (client and number, and for an answer the agent)
  // stays as it is.
  [[nodiscard]] Result<void> Add(const mission::NowCommand& command, std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> Add(const mission::NowAnswer& answer);

  struct CommandPage {
    std::vector<mission::GivenCommand> commands{};  // the newest first, with up to 64 answers each
    std::uint64_t next = 0;
  };
  // Finds commands by agent (named in it, or having answered it), route, client and time.
  [[nodiscard]] Result<CommandPage> FindCommands(const mission::Query& query);

 private:
  struct Database;
  explicit MissionStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
