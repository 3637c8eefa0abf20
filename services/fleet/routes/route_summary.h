#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "services/archive/route_file.h"
#include "services/base/result.h"

namespace trailcast::fleet {

// Returns "40.1 m". The length is unknown without odometry.
[[nodiscard]] std::string LengthText(const route::RouteInfo& info);
// Returns what is in a route file, in a few lines for people.
[[nodiscard]] std::string FileText(const std::string& path, const archive::RouteFile& file);
// Returns the same, or why it was refused, as an object for programs.
[[nodiscard]] nlohmann::ordered_json FileJson(const std::string& path,
                                              const Result<archive::RouteFile>& file);

}  // namespace trailcast::fleet
