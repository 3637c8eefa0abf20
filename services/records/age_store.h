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

// For how long revisions lie in a store as they are, by the time that its server has itself seen
// pass: no clock that is set makes one old, and none grows older while the server does not run. A
// SQLite file of its own, created if missing; in memory alone for ":memory:". Errors name the file:
// kUnavailable (disk full, no such folder), kConflict (another process has it open), kCorrupt (no
// such file of ours, or a damaged one).
class AgeStore {
 public:
  // What of `Pass` a server that is killed forgets, at most.
  static constexpr std::chrono::milliseconds kKeptEvery{60'000};

  [[nodiscard]] static Result<std::unique_ptr<AgeStore>> Open(const std::filesystem::path& file);
  ~AgeStore();
  AgeStore(const AgeStore&) = delete;
  AgeStore& operator=(const AgeStore&) = delete;

  // So much time has passed since this was called last.
  [[nodiscard]] Result<void> Pass(std::chrono::milliseconds time);

  // Of each its age, which begins when it is seen here first, and anew with each other mark that
  // its store has put upon it as it grew.
  using Marked = std::pair<route::RouteKey, std::int64_t>;
  [[nodiscard]] Result<std::vector<std::chrono::milliseconds>> AgesOf(
      const std::vector<Marked>& revisions);

  // How many of `wanted` deletions there may be without anybody asking, for those to be at most
  // `most` in a day. What is returned is counted, on the disk.
  [[nodiscard]] Result<std::uint32_t> Allow(std::uint32_t wanted, std::uint32_t most);

 private:
  struct Database;
  explicit AgeStore(std::unique_ptr<Database> database);
  std::unique_ptr<Database> database_;
};

}  // namespace trailcast::store
