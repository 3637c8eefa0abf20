#pragma once

#include <filesystem>
#include <string>

#include "services/base/result.h"

namespace trailcast {

// What a text file that a person gives says, whatever program wrote it: its lines end with LF, the
// mark (BOM) that some begin with is no part of it. kNotFound, kUnavailable for a file that cannot
// be read, kInvalidArgument for one that is no text in UTF-8; the error names the file.
[[nodiscard]] Result<std::string> ReadTextFile(const std::filesystem::path& file);
// The same of bytes that were read already; the error names nothing.
[[nodiscard]] Result<std::string> PlainText(std::string bytes);

// Replaces the file's contents. The error names the file.
[[nodiscard]] Result<void> WriteTextFile(const std::filesystem::path& file,
                                         const std::string& text);

}  // namespace trailcast
