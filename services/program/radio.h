#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trailcast::program {

// Returns the quality of a radio's link, 0 to 100 %, from `text` in the form of /proc/net/wireless.
// An empty `interface` means the only radio. It is nothing if there is no such radio, or its
// quality is not given.
[[nodiscard]] std::optional<std::uint8_t> LinkPercent(std::string_view text,
                                                      std::string_view interface);
// Does the same for this machine.
[[nodiscard]] std::optional<std::uint8_t> LinkPercent(const std::string& interface);

}  // namespace trailcast::program
