#pragma once

#include <cstdint>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/recording/disturbance.h"
#include "services/lab/trial/recording/judge.h"

namespace trailcast::trial {

// Returns the order in which a recording of so many frames is shown; `seed` draws what is random.
// kInvalidArgument means that the recording is too short for the change.
[[nodiscard]] Result<std::vector<Shown>> OrderOf(const Disturbance& disturbance, int frames,
                                                 std::uint64_t seed);

// Says whether frames come in the order in which they were recorded, even if some are left out or
// repeated.
[[nodiscard]] bool GoesForward(const std::vector<Shown>& order);

}  // namespace trailcast::trial
