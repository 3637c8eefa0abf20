#pragma once

#include <cstdint>

#include "services/base/result.h"
#include "services/lab/sim/core/scene.h"
#include "services/lab/sim/places/place.h"

namespace trailcast::sim {

// How a built-in place has changed since it was taught. Shares are from 0 (as it was) to 1. With
// one seed, a larger share includes all changes of a smaller one.
struct PlaceChange {
  double night = 0.0;     // daylight and ceiling lamps are out, and lamps elsewhere are lit
  double textures = 0.0;  // this share of its materials has another one's texture
  double moved = 0.0;     // this share of its furniture is moved along by some decimetres
  std::uint64_t seed = 1;
};

// Returns the built-in place after that change. kInvalidArgument means that the place knows no
// changes, and names those that do.
[[nodiscard]] Result<Place> OpenChangedPlace(const std::string& name, const PlaceChange& change);

// Gives a share of the scene's textured materials the texture of another one.
void ChangeTextures(double share, std::uint64_t seed, Scene& scene);

}  // namespace trailcast::sim
