#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace trailcast::program {

// Keys keep the order in which they were given. Only sources include this; headers use
// <nlohmann/json_fwd.hpp>, which compiles fast.
using Json = nlohmann::ordered_json;

// Returns one line. Bytes that are no UTF-8 become U+FFFD, because texts may come from anybody.
[[nodiscard]] std::string OneLine(const Json& json);
// Returns the form that programs print, for people to read.
[[nodiscard]] std::string Indented(const Json& json);

// Rounds to so many parts of one, coarsely, so that noise is no news.
[[nodiscard]] double Rounded(double value, double parts);
// Returns null if it is not known.
[[nodiscard]] Json RoundedOrNull(std::optional<double> value, double parts);
template <typename Value>
[[nodiscard]] Json OrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace trailcast::program
