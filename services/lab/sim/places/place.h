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

// A world, and the path on which a scout is driven through it.
struct Place {
  std::shared_ptr<const World> world;
  DrivenPath path;
  double speed_mps = 0.4;  // of a scout on the straight
  double slip = 0.02;      // of wheels on this ground (Disturbances::slip)
  // Returns the people and things that move there (traffic.h); null if nobody does.
  Result<Actors> (*traffic)(const Place& place, Role role, std::uint64_t seed) = nullptr;
};

[[nodiscard]] const std::vector<std::string>& BuiltInPlaces();
// Returns a line on a built-in place, or nothing if there is none of that name.
[[nodiscard]] std::optional<std::string> DescribePlace(const std::string& name);

// Makes the built-in place, or reads the files. Errors say what is wrong and what exists.
[[nodiscard]] Result<Place> OpenPlace(const PlaceOptions& options);

}  // namespace trailcast::sim
