#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

namespace trailcast::agent {

// Reads the fields of a Protobuf message, which may come from anybody, one after the other. A
// damaged field ends it.
class ProtobufReader {
 public:
  struct Field {
    std::uint64_t number = 0;
    std::span<const std::uint8_t> bytes;  // of a message or a text; otherwise empty
    double real = NAN;                    // of a double; otherwise NaN
    std::uint64_t integer = 0;            // of an integer; otherwise 0
  };

  explicit ProtobufReader(std::span<const std::uint8_t> message) : left_(message) {}

  [[nodiscard]] std::optional<Field> Next() {
    if (failed_ || left_.empty()) return std::nullopt;
    const std::uint64_t tag = Varint();
    Field field{.number = tag >> 3U, .bytes = {}};
    switch (tag & 7U) {
      case 0:
        field.integer = Varint();
        break;
      case 1:
        field.real = std::bit_cast<double>(Fixed(8));
        break;
      case 2:
        field.bytes = Take(Varint());
        break;
      case 5:
        (void)Fixed(4);
        break;
      default:
        failed_ = true;
    }
    failed_ = failed_ || field.number == 0;
    if (failed_) return std::nullopt;
    return field;
  }
  // Says, once there is no next field, whether that was the message's end.
  [[nodiscard]] bool whole() const { return !failed_; }

 private:
  std::span<const std::uint8_t> Take(std::uint64_t count) {
    failed_ = failed_ || count > left_.size();
    if (failed_) return {};
    const auto taken = left_.first(static_cast<std::size_t>(count));
    left_ = left_.subspan(taken.size());
    return taken;
  }
  std::uint64_t Fixed(std::size_t count) {
    const auto bytes = Take(count);
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8U | bytes[i - 1];
    return value;
  }
  std::uint64_t Varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = Take(1);
      if (byte.empty()) return 0;
      value |= std::uint64_t{byte[0] & 0x7FU} << shift;
      if ((byte[0] & 0x80U) == 0) return value;
    }
    failed_ = true;
    return 0;
  }

  std::span<const std::uint8_t> left_;
  bool failed_ = false;
};

}  // namespace trailcast::agent
