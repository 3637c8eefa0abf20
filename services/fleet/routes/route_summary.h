#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/archive/route_file.h"
#include "services/base/result.h"

namespace trailcast::fleet {

// "40.1 m"; without odometry nobody knows.
[[nodiscard]] std::string LengthText(const route::RouteInfo& info);
// What is in a route file, a few lines for people.
[[nodiscard]] std::string FileText(const std::string& path, const archive::RouteFile& file);
// The same, or why it was refused, as an object for programs.
[[nodiscard]] nlohmann::ordered_json FileJson(const std::string& path,
                                              const Result<archive::RouteFile>& file);

}  // namespace trailcast::fleet
