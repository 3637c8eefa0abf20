#include "services/lab/sim/places/src/outdoor_kit.h"

#include <utility>

namespace trailcast::sim {

Result<Place> FinishOutdoors(OutdoorKit& kit, const std::string& name, GroundMode ground,
                             Polyline points) {
  Scene scene = kit.builder.Take(name);
  scene.ground = ground;
  scene.lighting = kit.lighting;
  auto world = World::Build(std::move(scene));
  if (!world) return tl::unexpected(world.error());
  Place place;
  place.world = std::move(*world);
  place.path.points = std::move(points);
  place.speed_mps = kOutdoorSpeed_mps;
  return place;
}

}  // namespace trailcast::sim
