#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trailcast::store {

// These read rows as they are in a file: https://www.sqlite.org/fileformat.html, "Record Format".
// Any bytes may be given.

struct RecordValue {
  enum class Kind : std::uint8_t { kNull, kInteger, kReal, kText, kBlob };
  Kind kind = Kind::kNull;
  std::int64_t integer = 0;
  double real = 0.0;
  std::span<const std::uint8_t> bytes{};  // of a text or a blob, within the record
};
using Record = std::vector<RecordValue>;

// A number of one to nine bytes, and the bytes after it.
struct Varint {
  std::uint64_t value = 0;
  std::span<const std::uint8_t> rest{};
};
[[nodiscard]] std::optional<Varint> ReadVarint(std::span<const std::uint8_t> bytes);

// The types of a record's columns, which it has at its beginning.
struct RecordHeader {
  std::vector<std::uint64_t> types;  // one for each column
  std::size_t bytes = 0;             // of the header itself
  std::uint64_t record_bytes = 0;    // of the whole record
};
// Returns nothing if those bytes begin no record, or one of more than `most_columns`.
[[nodiscard]] std::optional<RecordHeader> ReadRecordHeader(std::span<const std::uint8_t> bytes,
                                                           std::size_t most_columns);
// `record` must have header.record_bytes.
[[nodiscard]] Record ReadRecord(const RecordHeader& header, std::span<const std::uint8_t> record);

}  // namespace trailcast::store
