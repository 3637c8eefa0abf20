#include "services/program/json.h"

#include <cmath>

namespace trailcast::program {

std::string OneLine(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Indented(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double Rounded(double value, double parts) {
  return std::isfinite(value) ? std::round(value * parts) / parts : 0.0;
}

Json RoundedOrNull(std::optional<double> value, double parts) {
  return value && std::isfinite(*value) ? Json(Rounded(*value, parts)) : Json(nullptr);
}

}  // namespace trailcast::program
