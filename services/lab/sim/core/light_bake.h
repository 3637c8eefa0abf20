#pragma once

#include <Eigen/Core>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/scene.h"

namespace trailcast::sim {

// A ceiling lamp or a window: a spot that shines into the half-space of `direction` by the cosine.
struct Lamp {
  Eigen::Vector3f position;
  Eigen::Vector3f direction;
  float strength = 1.0F;  // light on a surface one metre straight before it
};

// Computes once how much light arrives at each corner of the scene's triangles, from the lamps with
// their shadows and from all around, and writes it to the meshes' `shade`. Soft indoor light then
// costs nothing while rendering. It is deterministic. `ambient` is the light that has bounced about
// the room, at a place where everything is open.
[[nodiscard]] Result<void> BakeLight(const std::vector<Lamp>& lamps, Scene& scene,
                                     float ambient = 0.55F);

}  // namespace trailcast::sim
