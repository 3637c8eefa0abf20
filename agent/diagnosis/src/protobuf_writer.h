#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

namespace trailcast::agent {

// Writes the bytes of a Protobuf message (protobuf.dev/programming-guides/encoding), field by
// field. Generated code for messages with a google.protobuf.Timestamp would need the whole library,
// which robots do without.
class ProtobufWriter {
 public:
  ProtobufWriter& Number(std::uint32_t field, std::uint64_t value) {
    Varint(Tag(field, 0));
    Varint(value);
    return *this;
  }
  ProtobufWriter& Double(std::uint32_t field, double value) {
    Varint(Tag(field, 1));
    const auto bits = std::bit_cast<std::uint64_t>(value);
    for (unsigned shift = 0; shift < 64; shift += 8) Byte(bits >> shift);
    return *this;
  }
  ProtobufWriter& Bytes(std::uint32_t field, std::string_view bytes) {
    Varint(Tag(field, 2));
    Varint(bytes.size());
    bytes_.append(bytes);
    return *this;
  }
  ProtobufWriter& Message(std::uint32_t field, const ProtobufWriter& message) {
    return Bytes(field, message.bytes_);
  }

  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  static std::uint64_t Tag(std::uint32_t field, std::uint32_t wire_type) {
    return std::uint64_t{field} << 3U | wire_type;
  }
  void Byte(std::uint64_t value) { bytes_.push_back(static_cast<char>(value & 0xFFU)); }
  void Varint(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7U) Byte(value | 0x80U);
    Byte(value);
  }

  std::string bytes_;
};

}  // namespace trailcast::agent
