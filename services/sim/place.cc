#include "services/sim/place.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "services/sim/indoor_world.h"
#include "services/sim/load_world.h"

namespace trailcast::sim {
namespace {

constexpr const char* kIndoor = "indoor";

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
  static const std::vector<std::string> names = {kIndoor};
  return names;
}

Result<Place> OpenPlace(const PlaceOptions& options) {
  Place place;
  if (options.world == kIndoor) {
    auto built = MakeIndoorWorld();
    if (!built) return built;
    place = std::move(*built);
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
