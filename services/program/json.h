#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trailcast::program {

// Quoted for JSON. What of `text` is no UTF-8 becomes U+FFFD.
[[nodiscard]] std::string JsonText(std::string_view text);
// An array of values, each JSON already.
[[nodiscard]] std::string JsonList(const std::vector<std::string>& values);

}  // namespace trailcast::program
