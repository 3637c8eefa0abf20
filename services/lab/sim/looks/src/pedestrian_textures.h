#pragma once

#include <cstdint>

#include "services/image/canvas.h"
#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// What people wear and look like, once round them: the front in the middle, up is up.

// Plain, striped or checked, with a collar, a zip, pockets and a hem.
[[nodiscard]] TexturePtr Jacket(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr TrouserLeg(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr Head(image::Color skin, image::Color hair, std::uint64_t seed);

}  // namespace trailcast::sim
