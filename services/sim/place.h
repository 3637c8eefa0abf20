#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/sim/actor.h"
#include "services/sim/path.h"
#include "services/sim/world.h"

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

// Places by the words of a command line.
struct PlaceOptions {
  std::string world;            // a built-in place's name, or a world file (.obj, .glb, ...)
  std::filesystem::path path;   // x_m,y_m way-points; empty: the built-in place's own
  std::string up = "z";         // of a world file: y or z
  double scale = 1.0;           // metres per unit of a world file
  std::string ground = "mesh";  // what robots stand on: mesh or flat
};

[[nodiscard]] const std::vector<std::string>& BuiltInPlaces();
// A line on what a built-in place is; nothing where there is none of that name.
[[nodiscard]] std::optional<std::string> DescribePlace(const std::string& name);

// Makes the built-in place, or reads the files. Errors name what is wrong and what there is.
[[nodiscard]] Result<Place> OpenPlace(const PlaceOptions& options);

}  // namespace trailcast::sim
