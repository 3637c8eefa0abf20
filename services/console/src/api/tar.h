#pragma once

#include <cstdint>
#include <string>

namespace trailcast::console {

// These make an archive that 'tar -x' takes (POSIX.1-1988, ustar). Each file is its header, its
// bytes, and TarPadding of their number; TarEnd is last.
// `name` has 99 bytes at most.
[[nodiscard]] std::string TarHeader(const std::string& name, std::uint64_t bytes,
                                    std::int64_t unix_s);
[[nodiscard]] std::string TarPadding(std::uint64_t bytes);
[[nodiscard]] std::string TarEnd();

}  // namespace trailcast::console
