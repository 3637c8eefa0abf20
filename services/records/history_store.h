#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/network/changes.h"
#include "services/route/route.h"

namespace trailcast::store {

// Keeps the changes of routes and of the network in a SQLite file of its own, created if missing. A
// call's data is on the disk when it returns. Errors name the file: kUnavailable (disk full, no
// such folder), kConflict (another process has it open), kCorrupt (not our file, or a damaged one).
class HistoryStore {
 public:
  // The oldest changes are deleted once there are one per cent more than `most_kept`.
  static constexpr std::int64_t kMostKept = 100'000;
  [[nodiscard]] static Result<std::unique_ptr<HistoryStore>> Open(
      const std::filesystem::path& file, std::int64_t most_kept = kMostKept);
  ~HistoryStore();
  HistoryStore(const HistoryStore&) = delete;
  HistoryStore& operator=(const HistoryStore&) = delete;

  // Returns since when all changes are kept: `now_unix_ms` for a new file, later if the oldest were
  // deleted.
  [[nodiscard]] Result<std::int64_t> KeptSince(std::int64_t now_unix_ms);

  // Returns a revision as it was last noted, if it was.
  [[nodiscard]] Result<std::optional<route::RouteInfo>> Noted(const route::RouteKey& key);
  // Notes all or nothing. Deleted revisions are dropped.
  [[nodiscard]] Result<void> Note(std::span<const network::Change> changes,
                                  std::span<const route::RouteInfo> revisions);

  // Returns changes at that time or later, the oldest first: it skips `skip` of them and returns at
  // most `most`.
  [[nodiscard]] Result<std::vector<network::Change>> Since(std::int64_t unix_ms, std::int64_t skip,
                                                           std::int64_t most);

 private:
  struct Database;
  explicit HistoryStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
