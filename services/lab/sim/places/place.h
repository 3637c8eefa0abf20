#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/actor.h"
#include "services/lab/sim/core/path.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/sim/places/place_options.h"

namespace trailcast::sim {

enum class Role { kScout, kFollower };

// A world and the path that a scout is driven along through it.
struct Place {
  std::shared_ptr<const World> world;
  DrivenPath path;
  double speed_mps = 0.4;  // of a scout on the straight
  double slip = 0.02;      // of wheels on this ground (Disturbances::slip)
  // Who moves there (traffic.h); nothing: nobody does.
  Result<Actors> (*traffic)(const Place& place, Role role, std::uint64_t seed) = nullptr;
};

[[nodiscard]] const std::vector<std::string>& BuiltInPlaces();
// A line on what a built-in place is; nothing where there is none of that name.
[[nodiscard]] std::optional<std::string> DescribePlace(const std::string& name);

// Makes the built-in place, or reads the files. Errors name what is wrong and what there is.
[[nodiscard]] Result<Place> OpenPlace(const PlaceOptions& options);

}  // namespace trailcast::sim
