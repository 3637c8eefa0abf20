#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace trailcast {

// Returns the length of the well-formed UTF-8 character that begins `text`, which is not empty, or
// 0 if there is none (truncated, overlong, a surrogate, beyond U+10FFFF). Source: the Unicode
// standard, table 3-7.
[[nodiscard]] std::size_t CharacterLength(std::string_view text);

// Says whether `text` is one line of valid UTF-8 without control characters and at most `max_bytes`
// long, so that a stranger's text can be printed on a terminal.
[[nodiscard]] bool IsPlainText(std::string_view text, std::size_t max_bytes);

// Makes `text` pass IsPlainText: it replaces characters that do not fit by spaces and cuts the rest
// off.
[[nodiscard]] std::string PlainText(std::string_view text, std::size_t max_bytes);

// Returns the words of `text`, which have spaces between them, any number of them.
[[nodiscard]] std::vector<std::string> WordsIn(std::string_view text);

}  // namespace trailcast
