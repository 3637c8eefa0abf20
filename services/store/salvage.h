#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

struct Salvaged {
  std::size_t routes = 0;
  std::size_t segments = 0;
  // Lines on what complete routes lack now, what else is known to be lost, and how many rows and
  // pages of the file cannot be read.
  std::vector<std::string> lost;
};

// Copies the whole parts of a store, however damaged or cut short it is, into a new one, `to`,
// which must not exist. It reads every page of the file and of its log, even those that no table
// has any more; deleted routes stay deleted by their tombstones. `from` is only read, and nothing
// else may have it open (kConflict). kCorrupt means that nothing in it can be read as a store;
// kUnavailable that there is no room for the new one, which is then removed.
[[nodiscard]] Result<Salvaged> Salvage(const std::filesystem::path& from,
                                       const std::filesystem::path& to,
                                       const SqliteOptions& options = {});

struct Repaired {
  Salvaged salvaged;
  std::filesystem::path kept;  // the damaged file; its log, if it had one, is beside it
};

// Replaces a store by its whole parts. Killed at any instant, it leaves the damaged store or the
// new one under the store's name, each with its own log. Errors are Salvage's.
[[nodiscard]] Result<Repaired> Repair(const std::filesystem::path& file);

}  // namespace trailcast::store
