#pragma once

#include <cstdint>
#include <span>

#include "services/base/result.h"

namespace trailcast::image {

// Whether what a stranger sent is a JPEG or a PNG that says it has at most `most_pixels`, and no
// more work for its decoder than such a picture is; kInvalidArgument says what is wrong. Nothing is
// decoded.
[[nodiscard]] Result<void> CheckPicture(std::span<const std::uint8_t> bytes,
                                        std::uint64_t most_pixels);

}  // namespace trailcast::image
