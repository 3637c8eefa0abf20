#pragma once

#include <string>
#include <string_view>

namespace trailcast {

// Length of the well-formed UTF-8 character at the beginning of `text`, which is not empty; 0 if
// there is none (truncated, overlong, a surrogate, beyond U+10FFFF). The Unicode standard, table
// 3-7.
[[nodiscard]] std::size_t CharacterLength(std::string_view text);

// Valid UTF-8 of one line: no control characters, so that what a stranger sent can be printed on a
// terminal, and at most `max_bytes` long.
[[nodiscard]] bool IsPlainText(std::string_view text, std::size_t max_bytes);

// `text` made to pass IsPlainText: what does not fit is replaced by spaces or cut off.
[[nodiscard]] std::string PlainText(std::string_view text, std::size_t max_bytes);

}  // namespace trailcast
