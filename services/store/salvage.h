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
  // A line each: what complete routes lack now, what else is known to have been there, and how many
  // rows and pages of the file cannot be read.
  std::vector<std::string> lost;
};

// Copies what is whole of a store, however damaged or cut short, into a new one, `to`, which must
// not exist. Every page of the file and of its log is looked at, those too that no table has any
// more: what was deleted stays deleted by its tombstone. Reads `from` only; nothing else may have
// it open (kConflict). kCorrupt if nothing in it can be read as a store; kUnavailable when there is
// no room for the new one, which is then not there.
[[nodiscard]] Result<Salvaged> Salvage(const std::filesystem::path& from,
                                       const std::filesystem::path& to,
                                       const SqliteOptions& options = {});

struct Repaired {
  Salvaged salvaged;
  std::filesystem::path kept;  // the damaged file; its log, if it had one, is beside it
};

// Makes what is whole of a store the store. Killed at any instant, it leaves the damaged one or the
// new one under the store's name, each with its own log. Errors as of Salvage.
[[nodiscard]] Result<Repaired> Repair(const std::filesystem::path& file);

}  // namespace trailcast::store
