#pragma once

#include <cstdint>
#include <span>

namespace trailcast::image {

// Returns how many pixels an encoded picture's header promises, or 0 if it is neither PNG nor JPEG
// or is cut off before it says so. A decoder allocates memory for that many before it looks at the
// rest.
[[nodiscard]] std::uint64_t PromisedPixels(std::span<const std::uint8_t> bytes);

}  // namespace trailcast::image
