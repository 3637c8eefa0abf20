#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace trailcast::console {

using Json = nlohmann::ordered_json;

// Texts of others may be no UTF-8.
[[nodiscard]] inline std::string Text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trailcast::console
