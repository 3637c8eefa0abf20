#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>

namespace trailcast::bag {

// Takes little-endian numbers and texts out of bytes that may be damaged. If bytes are missing, the
// value is 0 or empty, and the reader has failed from then on.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  template <std::unsigned_integral Number>
  [[nodiscard]] Number Take() {
    const auto bytes = TakeBytes(sizeof(Number));
    Number number = 0;
    for (std::size_t i = bytes.size(); i > 0; --i) {
      number = static_cast<Number>(static_cast<std::uint64_t>(number) << 8U | bytes[i - 1]);
    }
    return number;
  }
  [[nodiscard]] std::span<const std::uint8_t> TakeBytes(std::uint64_t count) {
    if (count > left_.size()) {
      failed_ = true;
      left_ = {};
      return {};
    }
    const auto bytes = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(bytes.size());
    return bytes;
  }
  // A text has four bytes of length and then its bytes.
  [[nodiscard]] std::string TakeText() {
    const auto bytes = TakeBytes(Take<std::uint32_t>());
    return {bytes.begin(), bytes.end()};
  }

  [[nodiscard]] std::span<const std::uint8_t> left() const { return left_; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::span<const std::uint8_t> left_;
  bool failed_ = false;
};

}  // namespace trailcast::bag
