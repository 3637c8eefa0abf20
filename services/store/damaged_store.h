#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

struct DamagedStore {
  // What is whole, to be read; every write is kUnavailable and says why.
  std::unique_ptr<RouteStore> whole;
  std::vector<std::string> lost;  // as Salvaged::lost
};

// Opens what OpenSqliteStore calls kCorrupt. The file stays as it is: what is whole is copied into
// another beside it, which goes with the store, so there must be room for that (kUnavailable).
// kCorrupt if nothing in it can be read as a store. Takes as long as reading the file does.
[[nodiscard]] Result<DamagedStore> OpenDamagedStore(const std::filesystem::path& file);

}  // namespace trailcast::store
