#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "services/base/result.h"

namespace trailcast {

// All of these use the time zone of the person who started the program (TZ, or the machine's).

// Returns "Mon 2026-11-23 09:15", or "at an unknown time".
[[nodiscard]] std::string LocalText(std::int64_t unix_ms);

// Returns the moment, in milliseconds since 1970, that a person means by a text:
//   monday, .., today, yesterday   when that day began; the last such weekday, which may be today
//   2026-11-23                     when that day began
//   09:15                          today, or yesterday if that time is still to come today
//   2026-11-23T09:15               also with a blank for the T, and with seconds
//   90min, 12h, 2d, 1w             so long ago; seconds (s), too
// Anything else, and any moment that is still to come, is kInvalidArgument with a list of these.
[[nodiscard]] Result<std::int64_t> ParseSince(std::string_view text, std::int64_t now_unix_ms);

}  // namespace trailcast
