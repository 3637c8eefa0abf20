#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::image {

// How a picture is to be turned, 1 to 8, by what its camera wrote into a JPEG's segment APP1;
// nothing: it does not say so.
[[nodiscard]] std::optional<int> ExifOrientation(std::span<const std::uint8_t> app1);

}  // namespace trailcast::image
