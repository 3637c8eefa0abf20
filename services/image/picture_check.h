#pragma once

#include <cstdint>
#include <span>

#include "services/base/result.h"

namespace trailcast::image {

// Checks, without decoding, that a stranger's bytes are a JPEG or a PNG that promises at most
// `most_pixels`, and that decoding it costs no more than such a picture does. kInvalidArgument says
// what is wrong.
[[nodiscard]] Result<void> CheckPicture(std::span<const std::uint8_t> bytes,
                                        std::uint64_t most_pixels);

}  // namespace trailcast::image
