#pragma once

#include <cstdint>
#include <string>

#include "services/base/result.h"

namespace trailcast::server {

enum class Condition : std::uint8_t {
  kWhole,
  kIncomplete,  // sound, but something that was stored is not there any more
  kDamaged,
};

// Reads everything in a store, a file or the PostgreSQL database of a URL, and tells on stdout what
// of it is damaged and what complete routes lack. With `repair`, what is whole becomes the store
// and the damaged file is kept beside it; a database is only ever read. Returns how the store is
// now. Errors: no store there, a file in use, nothing of it can be read, or a database is to be
// repaired.
[[nodiscard]] Result<Condition> Check(const std::string& location, bool repair);

}  // namespace trailcast::server
