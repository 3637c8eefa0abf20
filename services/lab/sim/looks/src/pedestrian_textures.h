#pragma once

#include <cstdint>

#include "services/image/canvas.h"
#include "services/lab/sim/core/texture.h"

namespace trailcast::sim {

// These are people's clothes, hair and faces, once round the body: the front is in the middle, and
// up is up.

// A jacket is plain, striped or checked, with a collar, a zip, pockets and a hem.
[[nodiscard]] TexturePtr Jacket(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr TrouserLeg(image::Color tint, std::uint64_t seed);
[[nodiscard]] TexturePtr Head(image::Color skin, image::Color hair, std::uint64_t seed);

}  // namespace trailcast::sim
