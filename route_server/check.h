#pragma once

#include <filesystem>

#include "services/base/result.h"

namespace trailcast::server {

// Reads everything in a store and tells on stdout what of it is damaged. With `repair`, what is
// whole becomes the store and the damaged file is kept beside it. True: the store is whole, now.
// Errors: no store there, in use, or nothing of it can be read.
[[nodiscard]] Result<bool> Check(const std::filesystem::path& store, bool repair);

}  // namespace trailcast::server
