#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "services/vda5050/protocol.h"

namespace trailcast::vda5050 {

// Returns where `value` is not as the schema has it, one line each; empty if it is. It knows what
// the schemas of VDA 5050 use, and names a keyword that it does not know.
[[nodiscard]] std::vector<std::string> Violations(const nlohmann::json& schema,
                                                  const nlohmann::json& value);

// Says whether the standard's schemas lie beside this checkout.
[[nodiscard]] bool HasSchemas();
// Returns what is wrong with a message on that topic, by the standard's own schema.
[[nodiscard]] std::vector<std::string> Violations(Version version, const std::string& topic,
                                                  const std::string& message);

}  // namespace trailcast::vda5050
