#pragma once

#include <filesystem>

#include "services/base/result.h"
#include "services/store/salvage.h"

namespace trailcast::store {

// Does what Salvage does, for a caller that has the file locked.
[[nodiscard]] Result<Salvaged> SaveWhole(const std::filesystem::path& from,
                                         const std::filesystem::path& to,
                                         const SqliteOptions& options);

}  // namespace trailcast::store
