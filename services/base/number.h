#pragma once

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace trailcast {

// Reads all of `text` as one number. Blanks and a plus sign are refused; "inf" and "nan" are
// numbers.
template <typename Number>
[[nodiscard]] std::optional<Number> ParseNumber(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return number;
}

// Reads the number, and returns nothing if it is not between `least` and `most`.
[[nodiscard]] inline std::optional<double> ParseNumberWithin(std::string_view text, double least,
                                                             double most) {
  const auto number = ParseNumber<double>(text);
  return number && *number >= least && *number <= most ? number : std::nullopt;
}

// The two ends of "FROM..TO"; either may be left out.
struct NumberRange {
  std::optional<double> from;
  std::optional<double> to;
};
// Reads all of `text` as a range of numbers between `least` and `most`. Its ends may be in either
// order.
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

// Reads as ParseNumber does. If `text` is no number, it returns false and leaves `number` alone.
template <typename Number>
[[nodiscard]] bool ReadNumber(std::string_view text, Number& number) {
  const auto parsed = ParseNumber<Number>(text);
  if (parsed) number = *parsed;
  return parsed.has_value();
}

}  // namespace trailcast
