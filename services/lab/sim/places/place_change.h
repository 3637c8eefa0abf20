#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/lab/sim/core/scene.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// What has become of a built-in place since it was taught. Shares are from 0 (as it was) to 1; of
// one seed, what a smaller share has changed a larger one has, too.
struct PlaceChange {
  double night = 0.0;     // daylight and ceiling lamps out, lamps that stand elsewhere lit
  double textures = 0.0;  // this share of its materials has another one's texture
  double moved = 0.0;     // this share of its furniture stands some decimetres further along
  std::uint64_t seed = 1;
};

// The built-in place after that change. kInvalidArgument for a place that knows none, naming those
// that do.
[[nodiscard]] Result<Place> OpenChangedPlace(const std::string& name, const PlaceChange& change);

// Gives a share of the scene's textured materials another one's texture.
void ChangeTextures(double share, std::uint64_t seed, Scene& scene);

}  // namespace trailcast::sim
