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

// What robots were sent and told to do and what became of it: a SQLite file of its own, created if
// missing, and made anew by nobody. What a call has stored is on the disk when it returns. Errors
// name the file: kUnavailable (disk full, no such folder), kConflict (another process has it open),
// kCorrupt (no such file of ours, or a damaged one).
class MissionStore {
 public:
  //
  // Of missions that have ended, and of commands, the oldest go once there are more than
  // `most_kept`, or one in a hundred more.
  static constexpr std::int64_t kMostKept = 100'000;
  static constexpr std::int64_t kMostUnanswered = 10'000;
  static constexpr std::int64_t kMostUnansweredOfClient = 1000;  // nobody shuts out the others
  [[nodiscard]] static Result<std::unique_ptr<MissionStore>> Open(
      const std::filesystem::path& file, std::int64_t most_kept = kMostKept);
  ~MissionStore();
  MissionStore(const MissionStore&) = delete;
  MissionStore& operator=(const MissionStore&) = delete;

  // Times are in milliseconds since 1970, by the caller's clock. All in one commit. A mission that
  // is there already (agent and id) stays as it is. Returns what is stored then, of each.
  // kUnavailable: too many wait, all told or of its client.
  [[nodiscard]] std::vector<Result<mission::Record>> Add(std::span<const mission::Mission> missions,
                                                         std::int64_t now_unix_ms);
  // All in one commit. Of each, false: it was no news (Report::change), or the mission is not
  // there.
  [[nodiscard]] Result<std::vector<bool>> Change(std::span<const mission::Report> reports,
                                                 std::int64_t now_unix_ms);

  // A mission that is there gets other orders. False: it is not there.
  [[nodiscard]] Result<bool> Amend(const AgentId& agent, const std::string& id,
                                   const std::string& orders);

  // Those that no robot has answered and no server has dropped, the oldest first.
  [[nodiscard]] Result<std::vector<mission::Record>> Unanswered();

  struct Page {
    std::vector<mission::Record> missions{};  // the newest first
    std::uint64_t next = 0;  // mission::Query::before of the next; 0: the last page
  };
  [[nodiscard]] Result<Page> Find(const mission::Query& query);

  // What is there already (client and number; of an answer, the agent besides) stays as it is.
  [[nodiscard]] Result<void> Add(const mission::NowCommand& command, std::int64_t now_unix_ms);
  [[nodiscard]] Result<void> Add(const mission::NowAnswer& answer);

  struct CommandPage {
    std::vector<mission::GivenCommand> commands{};  // the newest first, 64 answers of each
    std::uint64_t next = 0;
  };
  // By agent (meant by name, or one that has answered), route, client and time.
  [[nodiscard]] Result<CommandPage> FindCommands(const mission::Query& query);

 private:
  struct Database;
  explicit MissionStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
