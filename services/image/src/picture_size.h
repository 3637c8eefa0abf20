#pragma once

#include <cstdint>
#include <span>

namespace trailcast::image {

// How many pixels an encoded picture's header promises; 0 when it is neither PNG nor JPEG, or cut
// short before it says so. A decoder makes room for as many before it looks at the rest.
[[nodiscard]] std::uint64_t PromisedPixels(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::image
