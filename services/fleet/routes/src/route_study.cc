#include "services/fleet/routes/route_study.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/base/angles.h"
#include "services/fleet/routes/route_export.h"
#include "services/program/json.h"
#include "services/route/codec.h"

namespace trailcast::fleet {
namespace {

using program::Json;
using program::Rounded;

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

Json ExtentJson(const route::RouteInfo& info, double begin, double end) {
  const std::string unit = UnitOf(info);
  return {{"begin_" + unit, Rounded(begin, 100.0)}, {"end_" + unit, Rounded(end, 100.0)}};
}

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
  return RouteStudy{finder.Places(), terrain.sections()};
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

Json WeakPlacesJson(const route::RouteInfo& info, const RouteStudy& study) {
  Json places = Json::array();
  for (const view::WeakPlace& place : study.weak_places) {
    Json each = ExtentJson(info, place.begin, place.end);
    each["why"] = NameOf(place.why);
    each["features"] = place.features;
    places.push_back(std::move(each));
  }
  return places;
}

std::string GroundText(const route::RouteInfo& info, const RouteStudy& study) {
  const std::string route = fmt::format("'{}' revision {}", info.name, info.revision.value());
  const bool known =
      std::any_of(study.terrain.begin(), study.terrain.end(),
                  [](const route::TerrainSection& section) { return section.terrain.known(); });
  if (!known) return fmt::format("{}: of its ground nothing is known\n", route);
  std::string text = fmt::format("{}: its ground\n", route);
  for (const route::TerrainSection& section : study.terrain) {
    text += fmt::format("  {:>8.1f} to {:>8.1f} {}  {}\n", section.begin, section.end, UnitOf(info),
                        route::TerrainText(section.terrain));
  }
  return text;
}

Json GroundJson(const route::RouteInfo& info, const RouteStudy& study) {
  Json sections = Json::array();
  for (const route::TerrainSection& section : study.terrain) {
    const route::Terrain& terrain = section.terrain;
    Json each = ExtentJson(info, section.begin, section.end);
    if (const auto roughness = route::RoughnessOf(terrain)) {
      each["roughness"] = route::NameOf(*roughness);
    }
    if (terrain.shake) each["shake"] = Rounded(*terrain.shake, 1e4);
    if (terrain.vertical_mps2) each["vertical_mps2"] = Rounded(*terrain.vertical_mps2, 100.0);
    if (terrain.slope_rad) each["slope_deg"] = Rounded(Degrees(*terrain.slope_rad), 10.0);
    sections.push_back(std::move(each));
  }
  return sections;
}

}  // namespace trailcast::fleet
