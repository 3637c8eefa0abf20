#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/mission/mission.h"
#include "services/mission/now.h"

namespace trailcast::store {

// Keeps missions and commands, and what became of them, in a SQLite file of its own, created if
// missing. A call's data is on the disk when it returns. Errors name the file: kUnavailable (disk
// full, no such folder), kConflict (another process has it open), kCorrupt (not our file, or a
// damaged one).
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
    bool operator==(const Hold&) const = default;
  };
  [[nodiscard]] Result<void> Put(const Hold& hold);
  [[nodiscard]] Result<void> ForgetHold(const AgentId& agent);
  [[nodiscard]] Result<std::vector<Hold>> Holds();

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
