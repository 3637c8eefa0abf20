#include "services/console/rights.h"

#include <string_view>

namespace trailcast::console {
namespace {

using users::Role;

struct Row {
  std::string_view method;
  std::string_view path;  // a '*' stands for one part
  std::optional<Role> needs;
};

constexpr Row kRows[] = {
    {"GET", "/", std::nullopt},
    {"GET", "/page.js", std::nullopt},
    {"GET", "/code/*", std::nullopt},
    {"GET", "/page.css", std::nullopt},
    {"GET", "/icon.svg", std::nullopt},
    {"GET", "/api/openapi.yaml", std::nullopt},
    {"POST", "/api/log-in", std::nullopt},
    {"POST", "/api/log-out", std::nullopt},

    {"GET", "/api/me", Role::kLook},
    {"GET", "/api/state", Role::kLook},
    {"GET", "/api/events", Role::kLook},
    {"GET", "/api/alerts", Role::kLook},
    {"GET", "/api/missions", Role::kLook},
    {"GET", "/api/figures", Role::kLook},
    {"GET", "/api/robots/*/snapshot", Role::kLook},
    {"GET", "/api/commands", Role::kLook},
    {"GET", "/api/changes", Role::kLook},
    {"GET", "/api/routes", Role::kLook},
    {"GET", "/api/routes/*/shape", Role::kLook},
    {"GET", "/api/network", Role::kLook},
    {"GET", "/api/network/way", Role::kLook},
    {"GET", "/api/schedules", Role::kLook},
    {"GET", "/api/schedules/calendar", Role::kLook},
    {"GET", "/api/photos", Role::kLook},
    {"GET", "/api/photos.tar", Role::kLook},
    {"GET", "/api/photos/*", Role::kLook},
    {"GET", "/api/photos/*/picture", Role::kLook},
    {"GET", "/api/photos/*/changes", Role::kLook},
    {"GET", "/api/photos/*/earlier", Role::kLook},
    {"GET", "/api/site/geojson", Role::kLook},
    {"GET", "/api/runs", Role::kLook},
    {"GET", "/api/runs/*", Role::kLook},
    {"GET", "/api/runs/*/frames", Role::kLook},
    {"GET", "/api/runs/*/frames/*/seen", Role::kLook},
    {"GET", "/api/runs/*/frames/*/picture", Role::kLook},
    {"GET", "/api/site", Role::kLook},
    {"GET", "/api/site/plan", Role::kLook},
    {"GET", "/metrics", Role::kLook},

    {"POST", "/api/where", Role::kLook},
    {"POST", "/api/runs", Role::kLook},
    {"POST", "/api/transfers", Role::kLook},
    {"GET", "/api/transfers/*", Role::kLook},
    {"GET", "/api/transfers/*/file", Role::kLook},

    {"POST", "/api/all/stop", Role::kOperate},
    {"POST", "/api/all/home", Role::kOperate},
    {"POST", "/api/robots/*/home", Role::kOperate},
    {"POST", "/api/alerts/*/acknowledge", Role::kOperate},
    {"POST", "/api/robots/*/pause", Role::kOperate},
    {"POST", "/api/robots/*/resume", Role::kOperate},
    {"POST", "/api/robots/*/cancel", Role::kOperate},
    {"POST", "/api/robots/*/stop", Role::kOperate},
    {"POST", "/api/robots/*/release", Role::kOperate},
    {"POST", "/api/robots/*/end", Role::kOperate},
    {"POST", "/api/robots/*/forget", Role::kOperate},
    {"POST", "/api/robots/*/drive", Role::kOperate},
    {"POST", "/api/missions", Role::kOperate},
    {"POST", "/api/robots/*/missions", Role::kOperate},
    {"POST", "/api/network/edits", Role::kOperate},
    {"POST", "/api/schedules", Role::kOperate},
    {"POST", "/api/schedules/preview", Role::kOperate},
    {"PUT", "/api/schedules/*", Role::kOperate},
    {"DELETE", "/api/schedules/*", Role::kOperate},
    {"POST", "/api/schedules/*/*", Role::kOperate},
    {"PUT", "/api/site/placements/*", Role::kOperate},
    {"DELETE", "/api/site/placements/*", Role::kOperate},
    {"POST", "/api/routes/*/edits", Role::kAdminister},
    {"POST", "/api/transfers/uploads", Role::kAdminister},
    {"GET", "/api/users", Role::kAdminister},
    {"POST", "/api/users", Role::kAdminister},
    {"PUT", "/api/users/*", Role::kAdminister},
    {"DELETE", "/api/users/*", Role::kAdminister},
};

bool IsMeant(std::string_view path, std::string_view pattern) {
  while (true) {
    const std::size_t part = std::min(path.find('/'), path.size());
    const std::size_t wanted = std::min(pattern.find('/'), pattern.size());
    const bool fits = pattern.substr(0, wanted) == "*"
                          ? part > 0
                          : pattern.substr(0, wanted) == path.substr(0, part);
    const bool path_ends = part == path.size();
    const bool pattern_ends = wanted == pattern.size();
    if (!fits || path_ends != pattern_ends) return false;
    if (path_ends) return true;
    path.remove_prefix(part + 1);
    pattern.remove_prefix(wanted + 1);
  }
}

}  // namespace

Right RightTo(const std::string& method, const std::string& path) {
  for (const Row& row : kRows) {
    if (row.method == method && IsMeant(path, row.path)) {
      return {.is_known = true, .needs = row.needs};
    }
  }
  if (method == "GET" && !path.starts_with("/api/"))
    return {.is_known = true, .needs = Role::kLook};
  return {};
}

std::string MethodsOf(const std::string& path) {
  std::string methods;
  for (const Row& row : kRows) {
    if (!IsMeant(path, row.path)) continue;
    methods += methods.empty() ? "" : ", ";
    methods += row.method;
    if (row.method == "GET") methods += ", HEAD";
  }
  return methods;
}

}  // namespace trailcast::console
