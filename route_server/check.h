#pragma once

#include <string>

#include "services/base/result.h"

namespace trailcast::server {

// Reads everything in a store, a file or the PostgreSQL database of a URL, and tells on stdout what
// of it is damaged. With `repair`, what is whole becomes the store and the damaged file is kept
// beside it; a database is only ever read. True: the store is whole, now. Errors: no store there, a
// file in use, nothing of it can be read, or a database is to be repaired.
[[nodiscard]] Result<bool> Check(const std::string& location, bool repair);

}  // namespace trailcast::server
