#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast {

// In the time zone of whoever started the program (TZ, or the machine's).

// "Mon 2026-11-23 09:15", or "at an unknown time".
[[nodiscard]] std::string LocalText(std::int64_t unix_ms);

// The moment, milliseconds since 1970, that a person means by it:
//   monday, .., today, yesterday   when that day began; a weekday's last one, which may be today
//   2026-11-23                     likewise
//   09:15                          today, or yesterday if it is not yet so late
//   2026-11-23T09:15               or with a blank, and with seconds
//   90min, 12h, 2d, 1w             so long ago; s, too
// kInvalidArgument, with all of these, for anything else and for what is yet to come.
[[nodiscard]] Result<std::int64_t> ParseSince(std::string_view text, std::int64_t now_unix_ms);

}  // namespace trailcast
