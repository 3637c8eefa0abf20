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

// What was changed of routes and of how they are joined: a SQLite file of its own, created if
// missing. What a call has stored is on the disk when it returns. Errors name the file:
// kUnavailable (disk full, no such folder), kConflict (another process has it open), kCorrupt (no
// such file of ours, or a damaged one).
class HistoryStore {
 public:
  // The oldest changes go once there are more than `most_kept`, or one in a hundred more.
  static constexpr std::int64_t kMostKept = 100'000;
  [[nodiscard]] static Result<std::unique_ptr<HistoryStore>> Open(
      const std::filesystem::path& file, std::int64_t most_kept = kMostKept);
  ~HistoryStore();
  HistoryStore(const HistoryStore&) = delete;
  HistoryStore& operator=(const HistoryStore&) = delete;

  // From when on all changes are there: `now_unix_ms` of a new file, later where the oldest went.
  [[nodiscard]] Result<std::int64_t> KeptSince(std::int64_t now_unix_ms);

  // A revision as it was when it was last noted; nothing if it never was.
  [[nodiscard]] Result<std::optional<route::RouteInfo>> Noted(const route::RouteKey& key);
  // All or nothing. Deleted revisions are noted no more.
  [[nodiscard]] Result<void> Note(std::span<const network::Change> changes,
                                  std::span<const route::RouteInfo> revisions);

  // Of then or later, the oldest first: the first `most` after so many.
  [[nodiscard]] Result<std::vector<network::Change>> Since(std::int64_t unix_ms, std::int64_t skip,
                                                           std::int64_t most);

 private:
  struct Database;
  explicit HistoryStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
