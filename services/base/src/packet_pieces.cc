#include "services/base/packet_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "services/base/text_file.h"

namespace trailcast {
namespace {

// The kernel takes no further packet when a part of the memory is left, of which the pieces of a
// few large packets take more.
constexpr double kFull = 0.95;

constexpr std::uint64_t kAmple_bytes = 64U << 20U;
constexpr std::uint64_t kAmple_s = 3;

}  // namespace

bool PacketPieces::full() const {
  return static_cast<double>(held_bytes) >= kFull * static_cast<double>(most_bytes);
}

bool PacketPieces::ample() const { return most_bytes >= kAmple_bytes || kept_s <= kAmple_s; }

std::string PacketPieces::more() const {
  return fmt::format("sysctl -w net.ipv4.ipfrag_time={} net.ipv4.ipfrag_high_thresh={}",
                     std::min(kAmple_s, kept_s), std::max(kAmple_bytes, most_bytes));
}

std::optional<PacketPieces> ReadPacketPieces(const std::filesystem::path& proc) {
  const std::filesystem::path settings = proc / "sys" / "net" / "ipv4";
  const auto most_bytes = ReadNumber(settings / "ipfrag_high_thresh");
  const auto kept_s = ReadNumber(settings / "ipfrag_time");
  if (!most_bytes || !kept_s) return std::nullopt;
  std::ifstream counts(proc / "net" / "sockstat");
  for (std::string word; counts >> word;) {
    if (word != "FRAG:") continue;
    std::uint64_t packets = 0;
    std::uint64_t held_bytes = 0;
    if (!(counts >> word >> packets >> word >> held_bytes)) break;
    return PacketPieces{held_bytes, *most_bytes, *kept_s};
  }
  return std::nullopt;
}

}  // namespace trailcast
