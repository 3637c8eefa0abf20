#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::store {

// Keeps for how long revisions have been in a store unchanged, by the time that the server itself
// has seen pass. Setting a clock makes none old, and none ages while the server does not run. It
// uses a SQLite file of its own, created if missing; ":memory:" keeps it in memory. Errors name the
// file: kUnavailable (disk full, no such folder), kConflict (another process has it open), kCorrupt
// (not our file, or a damaged one).
class AgeStore {
 public:
  // A server that is killed forgets at most so much of what `Pass` told it.
  static constexpr std::chrono::milliseconds kKeptEvery{60'000};

  [[nodiscard]] static Result<std::unique_ptr<AgeStore>> Open(const std::filesystem::path& file);
  ~AgeStore();
  AgeStore(const AgeStore&) = delete;
  AgeStore& operator=(const AgeStore&) = delete;

  // Adds the time that has passed since the last call.
  [[nodiscard]] Result<void> Pass(std::chrono::milliseconds time);

  // Returns the age of each revision. It begins when the revision is first seen here, and anew
  // whenever its store has marked it differently because it grew.
  using Marked = std::pair<route::RouteKey, std::int64_t>;
  [[nodiscard]] Result<std::vector<std::chrono::milliseconds>> AgesOf(
      const std::vector<Marked>& revisions);

  // Returns how many of `wanted` deletions may happen on the server's own account without exceeding
  // `most` in a day. The returned number is counted, on the disk.
  [[nodiscard]] Result<std::uint32_t> Allow(std::uint32_t wanted, std::uint32_t most);

 private:
  struct Database;
  explicit AgeStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
