#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "services/security/authority.h"

namespace trailcast::tool {

// For people: one line a member.
[[nodiscard]] std::string KeysTable(const std::vector<security::Authority::Row>& rows);
// For programs: an array of objects.
[[nodiscard]] nlohmann::ordered_json KeysJson(const std::vector<security::Authority::Row>& rows);

}  // namespace trailcast::tool
