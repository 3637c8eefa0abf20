#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/security/authority.h"

namespace trailcast::tool {

// Returns a line for each member, for people.
[[nodiscard]] std::string KeysTable(const std::vector<security::Authority::Row>& rows);
// Returns an array of objects, for programs.
[[nodiscard]] nlohmann::ordered_json KeysJson(const std::vector<security::Authority::Row>& rows);

}  // namespace trailcast::tool
