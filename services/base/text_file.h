#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>
#include <optional>
#include <string>

#include "services/base/result.h"

namespace trailcast {

// Reads a text file that a person gives, whatever program wrote it: lines end with LF in the
// result, and a byte order mark at the beginning is dropped. Errors: kNotFound, kUnavailable for a
// file that cannot be read, kInvalidArgument for one that is no UTF-8 text; they name the file.
[[nodiscard]] Result<std::string> ReadTextFile(const std::filesystem::path& file);
// Does the same with a stream, of which it reads no more than needed to tell that it is no text
// (as of /dev/zero). The error names no file.
[[nodiscard]] Result<std::string> ReadText(std::istream& stream);
// Does the same with bytes that were read already.
[[nodiscard]] Result<std::string> PlainText(std::string bytes);

// Reads the whole number with which a file begins, as the kernel's below /proc do.
[[nodiscard]] std::optional<std::uint64_t> ReadNumber(const std::filesystem::path& file);

// Replaces the file's contents. The error names the file.
[[nodiscard]] Result<void> WriteTextFile(const std::filesystem::path& file,
                                         const std::string& text);

}  // namespace trailcast
