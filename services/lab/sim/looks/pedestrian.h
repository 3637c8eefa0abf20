#pragma once

#include <cstdint>
#include <memory>

#include "services/base/result.h"
#include "services/lab/sim/core/actor.h"

namespace trailcast::sim {

struct PedestrianOptions {
  bool long_coat = false;  // down to the knees; otherwise a jacket
};

// Makes a person on foot, about 1.75 m tall, with swinging legs and arms. The seed draws clothes,
// hair and face.
[[nodiscard]] Result<std::shared_ptr<const ActorShape>> MakePedestrian(
    std::uint64_t seed, const PedestrianOptions& options = {});

}  // namespace trailcast::sim
