#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// MCAP, version 0: https://mcap.dev/spec. A file is the magic, records, and the magic again. A
// record is its opcode (1 byte), its length (8) and its content. Numbers are little-endian.
namespace trailcast::bag {

inline constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kRecordHeadBytes = 9;

enum class Opcode : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kDataEnd = 15,
};

struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  // of the content
};

struct McapSchema {
  std::uint16_t id = 0;
  std::string name;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  // 0: none
  std::string topic;
  std::string encoding;
};

struct McapMessage {
  std::uint16_t channel = 0;
  std::uint64_t log_time_ns = 0;
  std::span<const std::uint8_t> bytes;
};
inline constexpr std::size_t kMessageHeadBytes = 22;

struct McapChunk {
  std::uint64_t uncompressed_bytes = 0;
  std::uint32_t uncompressed_crc = 0;  // 0: not given
  std::string compression;
  std::uint64_t compressed_bytes = 0;
  std::span<const std::uint8_t> records;  // fewer bytes than compressed_bytes if they are cut off
};

struct McapStatistics {
  std::uint64_t messages = 0;
  std::uint32_t channels = 0;
  std::uint64_t message_start_ns = 0;
  std::uint64_t message_end_ns = 0;
  struct Count {
    std::uint16_t channel = 0;
    std::uint64_t messages = 0;
  };
  std::vector<Count> counts;
};

// These return nothing if there are too few bytes.
[[nodiscard]] std::optional<RecordHead> ParseRecordHead(std::span<const std::uint8_t> bytes);
[[nodiscard]] std::optional<McapSchema> ParseSchema(std::span<const std::uint8_t> content);
[[nodiscard]] std::optional<McapChannel> ParseChannel(std::span<const std::uint8_t> content);
[[nodiscard]] std::optional<McapMessage> ParseMessage(std::span<const std::uint8_t> content);
[[nodiscard]] std::optional<McapChunk> ParseChunk(std::span<const std::uint8_t> content);
[[nodiscard]] std::optional<McapStatistics> ParseStatistics(std::span<const std::uint8_t> content);

}  // namespace trailcast::bag
