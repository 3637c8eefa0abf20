#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace peer {

using Digest = std::array<std::uint8_t, 32>;

[[nodiscard]] Digest Sha256(const std::vector<std::uint8_t>& bytes);
// Returns a route's digest, over the digests of its segments, in order.
[[nodiscard]] Digest Manifest(const std::vector<Digest>& digests);
[[nodiscard]] std::string Hex(const Digest& digest);

}  // namespace peer
