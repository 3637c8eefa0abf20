#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace trailcast {

// This is where the kernel keeps the pieces (IPv4 fragments) of large packets until all of them
// have come. A piece that is lost leaves the others there for `kept_s`. Once they fill the memory,
// no large packet arrives any more.
struct PacketPieces {
  std::uint64_t held_bytes = 0;
  std::uint64_t most_bytes = 0;  // net.ipv4.ipfrag_high_thresh
  std::uint64_t kept_s = 0;      // net.ipv4.ipfrag_time

  [[nodiscard]] bool full() const;
  // Says whether lossy links leave room for pictures: Debian's 4 MB for 30 s are full within
  // seconds.
  [[nodiscard]] bool ample() const;
  // Returns the command that makes it ample.
  [[nodiscard]] std::string more() const;
};

// Returns that of this process's network, or nothing where the kernel does not tell.
[[nodiscard]] std::optional<PacketPieces> ReadPacketPieces(
    const std::filesystem::path& proc = "/proc");

}  // namespace trailcast
