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
  // One line for each thing that complete routes need and that could not be saved, and for each
  // stretch of the file that cannot be read.
  std::vector<std::string> lost;
};

// Copies what is whole of a store, however damaged or cut short, into a new one, `to`, which must
// not exist. Reads `from` only; nothing else may have it open (kConflict). kCorrupt if nothing in
// it can be read as a store; kUnavailable when there is no room for the new one, which is then not
// there.
[[nodiscard]] Result<Salvaged> Salvage(const std::filesystem::path& from,
                                       const std::filesystem::path& to,
                                       const SqliteOptions& options = {});

}  // namespace trailcast::store
