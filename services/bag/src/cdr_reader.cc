#include "services/bag/src/cdr_reader.h"

#include <algorithm>

namespace trailcast::bag {
namespace {

constexpr std::size_t kEncapsulationBytes = 4;
// The second byte says how plain types are encoded; the first is 0.
constexpr std::uint8_t kCdrBigEndian = 0;
constexpr std::uint8_t kCdrLittleEndian = 1;
constexpr std::uint8_t kCdr2BigEndian = 6;
constexpr std::uint8_t kCdr2LittleEndian = 7;

}  // namespace

CdrReader::CdrReader(std::span<const std::uint8_t> message) {
  const std::uint8_t encoding = message.size() >= kEncapsulationBytes ? message[1] : 0xFF;
  const bool second = encoding == kCdr2BigEndian || encoding == kCdr2LittleEndian;
  const bool first = encoding == kCdrBigEndian || encoding == kCdrLittleEndian;
  failed_ = (!first && !second) || message[0] != 0;
  if (failed_) return;
  little_endian_ = (encoding & 1U) != 0;
  if (second) most_alignment_ = 4;
  bytes_ = message.subspan(kEncapsulationBytes);
}

void CdrReader::Align(std::size_t size) {
  const std::size_t alignment = std::min(size, most_alignment_);
  at_ = (at_ + alignment - 1) / alignment * alignment;
}

std::span<const std::uint8_t> CdrReader::TakeBytes(std::size_t count) {
  if (failed_ || at_ > bytes_.size() || count > bytes_.size() - at_) {
    failed_ = true;
    return {};
  }
  const auto taken = bytes_.subspan(at_, count);
  at_ += count;
  return taken;
}

std::string CdrReader::TakeText() {
  const auto bytes = TakeBytes(Take<std::uint32_t>());
  const auto end = std::find(bytes.begin(), bytes.end(), 0);
  return {bytes.begin(), end};
}

}  // namespace trailcast::bag
