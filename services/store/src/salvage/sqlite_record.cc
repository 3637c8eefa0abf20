#include "services/store/src/salvage/sqlite_record.h"

#include <array>
#include <bit>

#include "services/store/src/salvage/big_endian.h"

namespace trailcast::store {
namespace {

using Kind = RecordValue::Kind;

constexpr std::uint64_t kRealType = 7;
constexpr std::uint64_t kZeroType = 8;
constexpr std::uint64_t kOneType = 9;
constexpr std::uint64_t kFirstBlobType = 12;  // even for a blob, odd for a text
constexpr std::uint64_t kMostBytes = 1U << 30U;

bool IsPossible(std::uint64_t type) {
  return type <= kOneType || (type >= kFirstBlobType && type < kMostBytes);
}

std::size_t BytesOf(std::uint64_t type) {
  constexpr std::array<std::size_t, 10> kFixed = {0, 1, 2, 3, 4, 6, 8, 8, 0, 0};
  return type < kFixed.size() ? kFixed.at(type) : (type - kFirstBlobType) / 2;
}

// Reads a number in two's complement of so many bytes.
std::int64_t ReadInteger(std::span<const std::uint8_t> bytes) {
  const std::uint64_t raw = BigEndian(bytes, 0, bytes.size());
  const auto unused = static_cast<unsigned>(64 - 8 * bytes.size());
  return static_cast<std::int64_t>(raw << unused) >> unused;
}

RecordValue ReadValue(std::uint64_t type, std::span<const std::uint8_t> bytes) {
  if (type >= kFirstBlobType) {
    return {.kind = type % 2 == 0 ? Kind::kBlob : Kind::kText, .bytes = bytes};
  }
  if (type == 0) return {};
  if (type == kRealType) {
    return {.kind = Kind::kReal, .real = std::bit_cast<double>(BigEndian(bytes, 0, 8))};
  }
  if (type >= kZeroType) return {.kind = Kind::kInteger, .integer = type == kOneType ? 1 : 0};
  return {.kind = Kind::kInteger, .integer = ReadInteger(bytes)};
}

}  // namespace

std::optional<Varint> ReadVarint(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 9 && i < bytes.size(); ++i) {
    if (i == 8) return Varint{value << 8U | bytes[i], bytes.subspan(9)};
    value = value << 7U | (bytes[i] & 0x7FU);
    if ((bytes[i] & 0x80U) == 0) return Varint{value, bytes.subspan(i + 1)};
  }
  return std::nullopt;
}

std::optional<RecordHeader> ReadRecordHeader(std::span<const std::uint8_t> bytes,
                                             std::size_t most_columns) {
  const auto size = ReadVarint(bytes);
  if (!size || size->value > bytes.size() || size->value < bytes.size() - size->rest.size()) {
    return std::nullopt;
  }
  RecordHeader header;
  header.bytes = header.record_bytes = size->value;
  std::span<const std::uint8_t> left =
      size->rest.first(size->rest.size() - (bytes.size() - header.bytes));
  while (!left.empty()) {
    const auto type = ReadVarint(left);
    if (!type || !IsPossible(type->value) || header.types.size() == most_columns) {
      return std::nullopt;
    }
    header.types.push_back(type->value);
    header.record_bytes += BytesOf(type->value);
    left = type->rest;
  }
  return header;
}

Record ReadRecord(const RecordHeader& header, std::span<const std::uint8_t> record) {
  Record values;
  std::size_t at = header.bytes;
  for (const std::uint64_t type : header.types) {
    const std::size_t bytes = BytesOf(type);
    values.push_back(ReadValue(type, record.subspan(at, bytes)));
    at += bytes;
  }
  return values;
}

}  // namespace trailcast::store
