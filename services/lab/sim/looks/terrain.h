#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/scene_builder.h"

namespace trailcast::sim {

// Uneven ground: a sum of smooth random waves, endless and without visible repeats.
class Terrain {
 public:
  struct Wave {
    float length_m;     // from bump to bump, about
    float amplitude_m;  // of most of them
  };
  Terrain(const std::vector<Wave>& waves, std::uint64_t seed);

  [[nodiscard]] float Height(float x, float y) const;

 private:
  // One of the plane waves whose sum looks random.
  struct Ripple {
    float kx, ky, phase, amplitude_m;
  };
  std::vector<Ripple> ripples_;
};

// The lines of a height field's grid along one axis: `cell_m` apart between the two places, and
// ever wider from there out to the limits.
struct GridLines {
  float low_limit, fine_from, fine_to, high_limit;
  float cell_m;
};

// Covers the grid with the surface at `height(x, y)`, in the builder's current place.
void AddHeightField(SceneBuilder& builder, MaterialId material, const GridLines& x,
                    const GridLines& y, float tile_m,
                    const std::function<float(float, float)>& height);

// Adds a stone of about that radius, half in the ground, at the origin of the builder's current
// place.
void AddBoulder(SceneBuilder& builder, MaterialId material, float radius_m, Random& random);

}  // namespace trailcast::sim
