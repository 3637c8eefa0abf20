#pragma once

#include <cstdint>
#include <string>

#include "services/base/result.h"

namespace trailcast::server {

enum class Condition : std::uint8_t {
  kWhole,
  kIncomplete,  // sound, but something that was stored is missing
  kDamaged,
};

// Reads everything in a store, which is a file or the PostgreSQL database of a URL. It reports on
// stdout what is damaged and what complete routes lack. With `repair`, the whole parts become the
// store, and the damaged file is kept beside it; a database is only read. Returns the store's
// condition. Errors: there is no store, the file is in use, nothing of it can be read, or a
// database was to be repaired.
[[nodiscard]] Result<Condition> Check(const std::string& location, bool repair);

}  // namespace trailcast::server
