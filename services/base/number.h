#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace trailcast {

// The number that all of `text` is; no blanks, no plus, and "inf" and "nan" are numbers too.
template <typename Number>
[[nodiscard]] std::optional<Number> ParseNumber(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

// The same; false, and `number` as it was, if `text` is none.
template <typename Number>
[[nodiscard]] bool ReadNumber(std::string_view text, Number& number) {
  const auto parsed = ParseNumber<Number>(text);
  if (parsed) number = *parsed;
  return parsed.has_value();
}

}  // namespace trailcast
