#include "services/dds/src/domain/user_data.h"

#include <fmt/format.h>

#include <charconv>

namespace trailcast::dds {
namespace {

constexpr std::string_view kMark = "trailcast-protocol=";

std::string_view WithoutSpaces(std::string_view text) {
  while (text.ends_with(' ')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::string ToText(const UserData& data) {
  if (!data.version) return data.name;
  return fmt::format("{}{}{}{}", data.name, data.name.empty() ? "" : " ", kMark, *data.version);
}

UserData ParseUserData(std::string_view text) {
  text = WithoutSpaces(text);
  const std::size_t word = text.rfind(' ') + 1;  // 0 if there is only one word
  if (text.substr(word).starts_with(kMark)) {
    const std::string_view digits = text.substr(word + kMark.size());
    const char* const end = digits.data() + digits.size();
    std::uint32_t version = 0;
    const auto [read_to, error] = std::from_chars(digits.data(), end, version);
    if (error == std::errc{} && read_to == end) {
      return {std::string(WithoutSpaces(text.substr(0, word))), version};
    }
  }
  return {std::string(text), std::nullopt};
}

}  // namespace trailcast::dds
