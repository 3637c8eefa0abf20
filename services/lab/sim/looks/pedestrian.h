#pragma once

#include <cstdint>
#include <memory>

#include "services/base/result.h"
#include "services/lab/sim/core/actor.h"

namespace trailcast::sim {

struct PedestrianOptions {
  bool long_coat = false;  // down to the knees; otherwise a jacket
};

// Somebody on foot, about 1.75 m tall: legs and arms that swing, clothes, hair and face drawn from
// the seed.
[[nodiscard]] Result<std::shared_ptr<const ActorShape>> MakePedestrian(
    std::uint64_t seed, const PedestrianOptions& options = {});

}  // namespace trailcast::sim
