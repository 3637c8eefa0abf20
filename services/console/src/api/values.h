#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace trailcast::console {

using Json = nlohmann::ordered_json;

// Texts of others may be no UTF-8.
[[nodiscard]] inline std::string Text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// To so many parts of one: coarse, so that noise is no news.
[[nodiscard]] inline double Rounded(double value, double parts) {
  return std::isfinite(value) ? std::round(value * parts) / parts : 0.0;
}

}  // namespace trailcast::console
