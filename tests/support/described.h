#pragma once

#include <httplib.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace trailcast::console {

// This is the console's description of itself, openapi.yaml, as JSON. It reads what that file has
// of YAML: maps and lists, in blocks and within a line, quotes, and texts over several lines.
[[nodiscard]] nlohmann::json ReadDescription(const std::string& yaml);

// Returns what in an answer differs from the description, one line each: a path, method or status
// that does not exist; a field that does not exist, is missing, or has another type.
[[nodiscard]] std::vector<std::string> UnlikeDescribed(const nlohmann::json& description,
                                                       const httplib::Request& request,
                                                       const httplib::Response& response);

// Returns a client's logger that checks each answer against the console's own description.
[[nodiscard]] httplib::Logger ExpectAsDescribed();

}  // namespace trailcast::console
