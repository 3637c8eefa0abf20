#pragma once

#include <string>
#include <string_view>

namespace trailcast::program {

// Quoted for JSON. `text` is UTF-8.
[[nodiscard]] std::string JsonText(std::string_view text);

}  // namespace trailcast::program
