#include "services/fleet/routes/route_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/base/angles.h"
#include "services/fleet/routes/route_export.h"
#include "services/route/codec.h"

namespace trailcast::fleet {
namespace {

std::string Explain(const view::WeakPlace& place) {
  switch (place.why) {
    case view::Weakness::kBland:
      return fmt::format("little to recognise, {} features: dark, blank or out of focus?",
                         place.features);
    case view::Weakness::kUnrelated:
      return fmt::format(
          "views in a row with {} features in common: driven too fast for the frame rate?",
          place.features);
    case view::Weakness::kBare:
      break;
  }
  return fmt::format("little to steer by, {} features: on by odometry", place.features);
}

const char* UnitOf(const route::RouteInfo& info) { return info.length_m > 0.0 ? "m" : "s"; }

}  // namespace

Result<RouteStudy> StudyRoute(OperatorPeer& peer, const route::RouteInfo& info,
                              const TransferWatch& watch) {
  view::WeakPlaceFinder finder(info.image_width_px);
  route::TerrainProfile terrain;
  const auto fetched =
      FetchInOrder(peer, info, watch, [&](const route::SegmentPiece& piece) -> Result<void> {
        const auto segment = route::Decode(piece.bytes);
        if (!segment) return Wrap(segment.error(), fmt::format("segment {}", piece.index.value()));
        finder.Add(*segment);
        terrain.Add(*segment);
        return {};
      });
  if (!fetched) return tl::unexpected(fetched.error());
  return RouteStudy{finder.Places(), terrain.stretches()};
}

std::string WeakPlacesText(const route::RouteInfo& info, const RouteStudy& study) {
  const std::string route = fmt::format("'{}' revision {}", info.name, info.revision.value());
  if (study.weak_places.empty()) return fmt::format("\n{}: no weak place\n", route);
  std::string text = fmt::format("\n{}: weak where\n", route);
  for (const view::WeakPlace& place : study.weak_places) {
    text += fmt::format("  {:>8.1f} to {:>8.1f} {}  {}\n", place.begin, place.end, UnitOf(info),
                        Explain(place));
  }
  return text;
}

std::string WeakPlacesJson(const route::RouteInfo& info, const RouteStudy& study) {
  std::string text = "[";
  for (const view::WeakPlace& place : study.weak_places) {
    text += fmt::format(
        "{}{{\"begin_{}\": {:.2f}, \"end_{}\": {:.2f}, \"why\": \"{}\", \"features\": {}}}",
        text.size() > 1 ? ", " : "", UnitOf(info), place.begin, UnitOf(info), place.end,
        NameOf(place.why), place.features);
  }
  return text + "]";
}

std::string GroundText(const route::RouteInfo& info, const RouteStudy& study) {
  const std::string route = fmt::format("'{}' revision {}", info.name, info.revision.value());
  const bool known =
      std::any_of(study.terrain.begin(), study.terrain.end(),
                  [](const route::TerrainStretch& stretch) { return stretch.terrain.known(); });
  if (!known) return fmt::format("{}: of its ground nothing is known\n", route);
  std::string text = fmt::format("{}: its ground\n", route);
  for (const route::TerrainStretch& stretch : study.terrain) {
    text += fmt::format("  {:>8.1f} to {:>8.1f} {}  {}\n", stretch.begin, stretch.end, UnitOf(info),
                        route::TerrainText(stretch.terrain));
  }
  return text;
}

std::string GroundJson(const route::RouteInfo& info, const RouteStudy& study) {
  std::string text = "[";
  for (const route::TerrainStretch& stretch : study.terrain) {
    const route::Terrain& terrain = stretch.terrain;
    text += fmt::format("{}{{\"begin_{}\": {:.2f}, \"end_{}\": {:.2f}", text.size() > 1 ? ", " : "",
                        UnitOf(info), stretch.begin, UnitOf(info), stretch.end);
    if (const auto roughness = route::RoughnessOf(terrain)) {
      text += fmt::format(", \"roughness\": \"{}\"", route::NameOf(*roughness));
    }
    if (terrain.shake) text += fmt::format(", \"shake\": {:.4f}", *terrain.shake);
    if (terrain.vertical_mps2)
      text += fmt::format(", \"vertical_mps2\": {:.2f}", *terrain.vertical_mps2);
    if (terrain.slope_rad)
      text += fmt::format(", \"slope_deg\": {:.1f}", Degrees(*terrain.slope_rad));
    text += "}";
  }
  return text + "]";
}

}  // namespace trailcast::fleet
