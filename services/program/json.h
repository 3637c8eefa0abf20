#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace trailcast::program {

// Keys stay in the order in which they were given. For sources: headers name it by
// <nlohmann/json_fwd.hpp>, which costs their readers nothing to compile.
using Json = nlohmann::ordered_json;

// Without line breaks. What of its texts is no UTF-8 becomes U+FFFD: it may be anybody's.
[[nodiscard]] std::string OneLine(const Json& json);
// As programs print it: people read along.
[[nodiscard]] std::string Indented(const Json& json);

// To so many parts of one: coarse, so that noise is no news.
[[nodiscard]] double Rounded(double value, double parts);
// null: it is not known.
[[nodiscard]] Json RoundedOrNull(std::optional<double> value, double parts);
template <typename Value>
[[nodiscard]] Json OrNull(const std::optional<Value>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace trailcast::program
