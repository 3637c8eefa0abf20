#pragma once

#include <string>
#include <vector>

#include "services/security/authority.h"

namespace trailcast::tool {

// For people: one line a member.
[[nodiscard]] std::string KeysTable(const std::vector<security::Authority::Row>& rows);
// For programs: an array of objects.
[[nodiscard]] std::string KeysJson(const std::vector<security::Authority::Row>& rows);

}  // namespace trailcast::tool
