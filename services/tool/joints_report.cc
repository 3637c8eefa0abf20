#include "services/tool/joints_report.h"

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

std::vector<FoundJoint> FindAllJoints(const std::vector<JoinableRoute>& routes, bool only_first) {
  std::vector<FoundJoint> found;
  for (std::size_t a = 0;
       a < (only_first ? std::min<std::size_t>(1, routes.size()) : routes.size()); ++a) {
    for (const joints::Joint& joint : joints::FindLoops(routes[a].views)) {
      found.push_back({a, a, joint});
    }
    for (std::size_t b = a + 1; b < routes.size(); ++b) {
      const bool same_camera = routes[a].info.camera == routes[b].info.camera;
      for (const joints::Joint& joint :
           joints::FindJoints(routes[a].views, routes[b].views, same_camera)) {
        found.push_back({a, b, joint});
      }
    }
  }
  return found;
}

std::string JointsText(const std::vector<JoinableRoute>& routes,
                       const std::vector<FoundJoint>& found) {
  std::string text;
  for (const auto& [a, b, joint] : found) {
    text += fmt::format("{} {} for {:.1f} {}, agreed by {} features, {:.2f} sure, {}\n",
                        PlaceText(routes, a, joint.at_a), PlaceText(routes, b, joint.at_b),
                        joint.length(), UnitOf(routes[a]), joint.features, joint.confidence,
                        HeadingText(joint.heading_rad));
  }
  if (!text.empty()) return text;
  if (routes.size() == 1) return "it does not come back to where it was\n";
  return fmt::format("no junctions of {} routes\n", routes.size());
}

Json JointsJson(const std::vector<JoinableRoute>& routes, const std::vector<FoundJoint>& found) {
  Json joints = Json::array();
  for (const auto& [a, b, joint] : found) {
    joints.push_back({{"a", SideJson(routes, a, joint.at_a, joint.end_a)},
                      {"b", SideJson(routes, b, joint.at_b, joint.end_b)},
                      {"length", Rounded(joint.length(), 100.0)},
                      {"views", joint.views},
                      {"features", joint.features},
                      {"confidence", Rounded(joint.confidence, 1000.0)},
                      {"heading_deg", Rounded(Degrees(joint.heading_rad), 10.0)},
                      {"heading_measured", joint.heading_scaled},
                      {"magnification", Rounded(std::exp(joint.log_scale), 1000.0)},
                      {"aside_m", nullptr}});
  }
  return {{"routes", routes.size()}, {"joints", std::move(joints)}};
}

}  // namespace trailcast::tool
