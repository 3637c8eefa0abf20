#include "services/lab/sim/places/place.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/lab/sim/core/load_world.h"
#include "services/lab/sim/places/indoor_world.h"
#include "services/lab/sim/places/src/field.h"
#include "services/lab/sim/places/src/narrow_road.h"
#include "services/lab/sim/places/src/offices.h"
#include "services/lab/sim/places/src/parking_lot.h"
#include "services/lab/sim/places/src/ramp.h"
#include "services/lab/sim/places/src/rough_ground.h"
#include "services/lab/sim/places/src/rows.h"
#include "services/lab/sim/places/traffic.h"

namespace trailcast::sim {
namespace {

struct BuiltInPlace {
  const char* name;
  const char* description;
  Result<Place> (*make)();
  decltype(Place::traffic) traffic = nullptr;
};
constexpr std::array kPlaces = {
    BuiltInPlace{"indoor", "15 m through a furnished laboratory", MakeIndoorWorld},
    BuiltInPlace{"paved", "60 m over a parking lot with cars, trees and buildings", MakePavedWorld,
                 PavementTraffic},
    BuiltInPlace{"rough", "40 m over rough ground, roll and pitch to 5 degrees", MakeRoughWorld},
    BuiltInPlace{"desks", "10 m between chairs and desks, tight", MakeDesksWorld},
    BuiltInPlace{"loop", "380 m round a large parking lot, back to the start", MakeLoopWorld},
    BuiltInPlace{"ramp", "40 m up and down a slanted ramp beside walls", MakeRampWorld},
    BuiltInPlace{"road", "80 m of narrow road between fences, hedges and houses", MakeRoadWorld,
                 RoadTraffic},
    BuiltInPlace{"turns", "25 m round the corners of an office", MakeTurnsWorld},
    BuiltInPlace{"corridor", "30 m of corridor, 4 m of it without texture", MakeCorridorWorld},
    BuiltInPlace{"dead-end", "18 m into a laboratory's dead end and back, turned on the spot",
                 MakeDeadEndWorld},
    BuiltInPlace{"parking-place", "22 m, backwards out of a parking place and on",
                 MakeParkingPlaceWorld},
    BuiltInPlace{"field", "30 m in the open, all features far away", MakeFieldWorld},
    BuiltInPlace{"rows", "50 m between rows of plants that look alike", MakeRowsWorld},
};

const BuiltInPlace* FindPlace(const std::string& name) {
  const auto* found = std::find_if(kPlaces.begin(), kPlaces.end(),
                                   [&](const BuiltInPlace& each) { return name == each.name; });
  return found == kPlaces.end() ? nullptr : found;
}

std::string ListOfPlaces() { return fmt::format("{}", fmt::join(BuiltInPlaces(), ", ")); }

Result<std::shared_ptr<const World>> LoadFile(const PlaceOptions& options) {
  const auto up = ParseUpAxis(options.up);
  if (!up) return tl::unexpected(up.error());
  const auto ground = ParseGroundMode(options.ground);
  if (!ground) return tl::unexpected(ground.error());
  auto world = LoadWorld({options.world, *up, options.scale, *ground});
  if (!world) {
    return Fail(world.error().code, "{} (built-in worlds: {})", world.error().message,
                ListOfPlaces());
  }
  return world;
}

}  // namespace

const std::vector<std::string>& BuiltInPlaces() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    all.reserve(kPlaces.size());
    for (const BuiltInPlace& each : kPlaces) all.emplace_back(each.name);
    return all;
  }();
  return names;
}

std::optional<std::string> DescribePlace(const std::string& name) {
  const BuiltInPlace* place = FindPlace(name);
  if (place == nullptr) return std::nullopt;
  return place->description;
}

Result<Place> OpenPlace(const PlaceOptions& options) {
  Place place;
  if (const BuiltInPlace* built_in = FindPlace(options.world)) {
    auto built = built_in->make();
    if (!built) return built;
    place = std::move(*built);
    if (options.path.empty()) place.traffic = built_in->traffic;  // traffic follows that path
  } else if (options.path.empty()) {
    return Fail(ErrorCode::kInvalidArgument,
                "the world {} has no path of its own: give --path FILE with the header x_m,y_m "
                "(built-in worlds: {})",
                options.world, ListOfPlaces());
  } else {
    auto world = LoadFile(options);
    if (!world) return tl::unexpected(world.error());
    place.world = std::move(*world);
  }
  if (options.path.empty()) return place;
  auto path = ReadPath(options.path);
  if (!path) return tl::unexpected(path.error());
  place.path = std::move(*path);
  return place;
}

}  // namespace trailcast::sim
