#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::image {

// Returns how a picture is to be turned, 1 to 8, as its camera wrote into a JPEG's segment APP1, or
// nothing if that does not say so.
[[nodiscard]] std::optional<int> ExifOrientation(std::span<const std::uint8_t> app1);

}  // namespace trailcast::image
