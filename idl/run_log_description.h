#pragma once

#include <cstdint>
#include <span>

namespace trailcast {

// run_log.proto and viewers.proto with all that they need, as Protobuf describes itself: a
// google.protobuf.FileDescriptorSet. Lives as long as the process.
[[nodiscard]] std::span<const std::uint8_t> RunLogDescription();

}  // namespace trailcast
