#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "services/base/result.h"

namespace trailcast::bag {

using Bytes = std::vector<std::uint8_t>;

enum class Compression : std::uint8_t { kNone, kLz4, kZstd };

// Names are those of MCAP: "", "lz4" (in frames), "zstd".
[[nodiscard]] const char* NameOf(Compression compression);
[[nodiscard]] std::optional<Compression> FindCompression(std::string_view name);

[[nodiscard]] Bytes Compress(Compression compression, std::span<const std::uint8_t> bytes);

struct Decompressed {
  Bytes bytes;         // as many as could be unpacked, up to the bound
  bool whole = false;  // the end was reached within the bound
};
// Unpacks bytes. It allocates memory as it goes, never for a size that is only promised.
[[nodiscard]] Decompressed Decompress(Compression compression, std::span<const std::uint8_t> bytes,
                                      std::uint64_t most_bytes);

[[nodiscard]] bool IsZstd(std::span<const std::uint8_t> bytes);
// Unpacks a whole file. Returns true if it reached the end, and false if the file breaks off; the
// part before that is written. Errors: the disk is full, or the result has more than a thousand
// times the file's size.
[[nodiscard]] Result<bool> DecompressZstdFile(const std::filesystem::path& from,
                                              const std::filesystem::path& to);

}  // namespace trailcast::bag
