#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/store/route_store.h"

namespace trailcast::store {

struct DamagedStore {
  // The whole parts, for reading; every write is kUnavailable and says why.
  std::unique_ptr<RouteStore> whole;
  std::vector<std::string> lost;  // see Salvaged::lost
};

// Opens a store for which OpenSqliteStore returns kCorrupt. The file stays as it is: its whole
// parts are copied into another file beside it, which is deleted with the store, so there must be
// room for it (kUnavailable). kCorrupt means that nothing in the file can be read as a store. It
// takes as long as reading the file.
[[nodiscard]] Result<DamagedStore> OpenDamagedStore(const std::filesystem::path& file);

}  // namespace trailcast::store
