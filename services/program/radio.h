#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trailcast::program {

// How good the link of a radio is, 0 to 100 %, as `text` in the form of /proc/net/wireless says it.
// `interface`: which radio; empty: the only one. Nothing where there is none such, or it does not
// say.
[[nodiscard]] std::optional<std::uint8_t> LinkPercent(std::string_view text,
                                                      std::string_view interface);
// This machine's.
[[nodiscard]] std::optional<std::uint8_t> LinkPercent(const std::string& interface);

}  // namespace trailcast::program
