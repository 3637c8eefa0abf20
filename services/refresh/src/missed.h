#pragma once

#include <cstdint>
#include <limits>

#include "services/refresh/visit.h"

namespace trailcast::refresh {

// Counts how many consecutive visits, up to this one, missed something.
inline void NoteVisit(Sought sought, std::uint8_t& missed) {
  if (sought == Sought::kFound) missed = 0;
  if (sought == Sought::kMissed && missed < std::numeric_limits<std::uint8_t>::max()) ++missed;
}

}  // namespace trailcast::refresh
