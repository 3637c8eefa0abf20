#include "services/tool/junctions_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/program/json.h"
#include "services/route/route_ref.h"

namespace trailcast::tool {
namespace {

using program::Json;
using program::Rounded;

std::string CalledIn(const std::vector<JoinableRoute>& routes, std::size_t which) {
  const route::RouteInfo& info = routes[which].info;
  const auto same = std::count_if(routes.begin(), routes.end(), [&](const JoinableRoute& each) {
    return each.info.name == info.name;
  });
  return same == 1 ? info.name : route::ShortIds().Of(info.key.route);
}

const char* UnitOf(const JoinableRoute& route) { return route.views.metric() ? "m" : "s"; }

std::string PlaceText(const std::vector<JoinableRoute>& routes, std::size_t which, double at) {
  return fmt::format("{}@{:.1f}{}", CalledIn(routes, which), at,
                     routes[which].views.metric() ? "" : "s");
}

std::string HeadingText(double heading_rad) {
  const double degrees = std::round(Degrees(heading_rad));
  if (degrees == 0.0) return "straight on";
  return fmt::format("{:.0f} degree{} to the {}", std::abs(degrees),
                     std::abs(degrees) == 1.0 ? "" : "s", degrees > 0.0 ? "left" : "right");
}

Json SideJson(const std::vector<JoinableRoute>& routes, std::size_t which, double at, double end) {
  const route::RouteInfo& info = routes[which].info;
  return {{"name", info.name},
          {"route", info.key.route.value()},
          {"revision", info.revision.value()},
          {"at", Rounded(at, 100.0)},
          {"end", Rounded(end, 100.0)},
          {"unit", UnitOf(routes[which])}};
}

}  // namespace

std::vector<FoundJunction> FindAllJunctions(const std::vector<JoinableRoute>& routes,
                                            bool only_first) {
  std::vector<FoundJunction> found;
  for (std::size_t a = 0;
       a < (only_first ? std::min<std::size_t>(1, routes.size()) : routes.size()); ++a) {
    for (const junctions::Junction& junction : junctions::FindLoops(routes[a].views)) {
      found.push_back({a, a, junction});
    }
    for (std::size_t b = a + 1; b < routes.size(); ++b) {
      const bool same_camera = routes[a].info.camera == routes[b].info.camera;
      for (const junctions::Junction& junction :
           junctions::FindJunctions(routes[a].views, routes[b].views, same_camera)) {
        found.push_back({a, b, junction});
      }
    }
  }
  return found;
}

std::string JunctionsText(const std::vector<JoinableRoute>& routes,
                          const std::vector<FoundJunction>& found) {
  std::string text;
  for (const auto& [a, b, junction] : found) {
    text += fmt::format("{} {} for {:.1f} {}, agreed by {} features, {:.2f} sure, {}\n",
                        PlaceText(routes, a, junction.at_a), PlaceText(routes, b, junction.at_b),
                        junction.length(), UnitOf(routes[a]), junction.features,
                        junction.confidence, HeadingText(junction.heading_rad));
  }
  if (!text.empty()) return text;
  if (routes.size() == 1) return "it does not come back to where it was\n";
  return fmt::format("no junctions of {} routes\n", routes.size());
}

Json JunctionsJson(const std::vector<JoinableRoute>& routes,
                   const std::vector<FoundJunction>& found) {
  Json junctions = Json::array();
  for (const auto& [a, b, junction] : found) {
    junctions.push_back({{"a", SideJson(routes, a, junction.at_a, junction.end_a)},
                         {"b", SideJson(routes, b, junction.at_b, junction.end_b)},
                         {"length", Rounded(junction.length(), 100.0)},
                         {"views", junction.views},
                         {"features", junction.features},
                         {"confidence", Rounded(junction.confidence, 1000.0)},
                         {"heading_deg", Rounded(Degrees(junction.heading_rad), 10.0)},
                         {"heading_measured", junction.heading_scaled},
                         {"magnification", Rounded(std::exp(junction.log_scale), 1000.0)},
                         {"aside_m", nullptr}});
  }
  return {{"routes", routes.size()}, {"joints", std::move(junctions)}};
}

}  // namespace trailcast::tool
