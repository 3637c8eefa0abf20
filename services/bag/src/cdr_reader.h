#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>

namespace trailcast::bag {

// Reads CDR (OMG DDS-XTYPES, section 7.4) as far as ROS 2's messages need it. Numbers are aligned
// to their size, counted from after the four bytes that tell the encoding; encoding 2 aligns to
// four at most. If bytes are missing, the value is 0 or empty, and the reader has failed from then
// on.
class CdrReader {
 public:
  explicit CdrReader(std::span<const std::uint8_t> message);

  template <std::unsigned_integral Number>
  [[nodiscard]] Number Take() {
    Align(sizeof(Number));
    const auto bytes = TakeBytes(sizeof(Number));
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      number = number << 8U | bytes[little_endian_ ? bytes.size() - 1 - i : i];
    }
    return static_cast<Number>(number);
  }
  [[nodiscard]] double TakeDouble() { return std::bit_cast<double>(Take<std::uint64_t>()); }
  // A text has its length, which counts the final 0, and then its bytes.
  [[nodiscard]] std::string TakeText();
  // A sequence of octets.
  [[nodiscard]] std::span<const std::uint8_t> TakeOctets() {
    return TakeBytes(Take<std::uint32_t>());
  }

  [[nodiscard]] bool failed() const { return failed_; }

 private:
  void Align(std::size_t size);
  std::span<const std::uint8_t> TakeBytes(std::size_t count);

  std::span<const std::uint8_t> bytes_;  // after the encapsulation
  std::size_t at_ = 0;
  std::size_t most_alignment_ = 8;
  bool little_endian_ = true;
  bool failed_ = false;
};

}  // namespace trailcast::bag
