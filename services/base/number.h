#pragma once

#include <charconv>
#include <cstddef>
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

// The same, from least to most.
[[nodiscard]] inline std::optional<double> ParseNumberWithin(std::string_view text, double least,
                                                             double most) {
  const auto number = ParseNumber<double>(text);
  return number && *number >= least && *number <= most ? number : std::nullopt;
}

// Of "FROM..TO", either of which may be left out.
struct NumberRange {
  std::optional<double> from;
  std::optional<double> to;
};
// What all of `text` is, its numbers from least to most; in whatever order.
[[nodiscard]] inline std::optional<NumberRange> ParseRange(std::string_view text, double least,
                                                           double most) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  NumberRange range;
  const auto read = [&](std::string_view end, std::optional<double>& number) {
    if (!end.empty()) number = ParseNumberWithin(end, least, most);
    return end.empty() || number;
  };
  if (!read(text.substr(0, dots), range.from) || !read(text.substr(dots + 2), range.to)) {
    return std::nullopt;
  }
  return range;
}

// The same as ParseNumber; false, and `number` as it was, if `text` is none.
template <typename Number>
[[nodiscard]] bool ReadNumber(std::string_view text, Number& number) {
  const auto parsed = ParseNumber<Number>(text);
  if (parsed) number = *parsed;
  return parsed.has_value();
}

}  // namespace trailcast
