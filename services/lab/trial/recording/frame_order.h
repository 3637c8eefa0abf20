#pragma once

#include <cstdint>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/recording/disturbance.h"
#include "services/lab/trial/recording/judge.h"

namespace trailcast::trial {

// In which order a recording of so many frames is shown, drawn from `seed` where there is something
// to draw. kInvalidArgument if the recording is too short for what is to be done to it.
[[nodiscard]] Result<std::vector<Shown>> OrderOf(const Disturbance& disturbance, int frames,
                                                 std::uint64_t seed);

// Whether frames come in the order in which they were recorded, some left out or shown again.
[[nodiscard]] bool GoesForward(const std::vector<Shown>& order);

}  // namespace trailcast::trial
