#include "services/tool/joints_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "services/base/angles.h"
#include "services/route/route_ref.h"

namespace trailcast::tool {
namespace {

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

std::string SideJson(const std::vector<JoinableRoute>& routes, std::size_t which, double at,
                     double end) {
  const route::RouteInfo& info = routes[which].info;
  return fmt::format(
      "{{\"name\": \"{}\", \"route\": \"{}\", \"revision\": {}, \"at\": {:.2f}, \"end\": {:.2f}, "
      "\"unit\": \"{}\"}}",
      info.name, info.key.route.value(), info.revision.value(), at, end, UnitOf(routes[which]));
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
  return fmt::format("no joints of {} routes\n", routes.size());
}

std::string JointsJson(const std::vector<JoinableRoute>& routes,
                       const std::vector<FoundJoint>& found) {
  std::string joints;
  for (const auto& [a, b, joint] : found) {
    joints += fmt::format(
        "{}\n    {{\"a\": {}, \"b\": {},\n     \"length\": {:.2f}, \"views\": {}, \"features\": "
        "{}, "
        "\"confidence\": {:.3f}, \"heading_deg\": {:.1f}, \"heading_measured\": {}, "
        "\"magnification\": {:.3f}, \"aside_m\": null}}",
        joints.empty() ? "" : ",", SideJson(routes, a, joint.at_a, joint.end_a),
        SideJson(routes, b, joint.at_b, joint.end_b), joint.length(), joint.views, joint.features,
        joint.confidence, Degrees(joint.heading_rad), joint.heading_scaled,
        std::exp(joint.log_scale));
  }
  return fmt::format("{{\n  \"routes\": {},\n  \"joints\": [{}]\n}}\n", routes.size(), joints);
}

}  // namespace trailcast::tool
