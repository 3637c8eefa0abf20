#include "services/bag/src/mcap_format.h"

#include "services/bag/src/byte_reader.h"

namespace trailcast::bag {

std::optional<RecordHead> ParseRecordHead(std::span<const std::uint8_t> bytes) {
  ByteReader reader(bytes);
  RecordHead head;
  head.opcode = static_cast<Opcode>(reader.Take<std::uint8_t>());
  head.length = reader.Take<std::uint64_t>();
  if (reader.failed()) return std::nullopt;
  return head;
}

std::optional<McapSchema> ParseSchema(std::span<const std::uint8_t> content) {
  ByteReader reader(content);
  McapSchema schema;
  schema.id = reader.Take<std::uint16_t>();
  schema.name = reader.TakeText();
  if (reader.failed()) return std::nullopt;
  return schema;
}

std::optional<McapChannel> ParseChannel(std::span<const std::uint8_t> content) {
  ByteReader reader(content);
  McapChannel channel;
  channel.id = reader.Take<std::uint16_t>();
  channel.schema = reader.Take<std::uint16_t>();
  channel.topic = reader.TakeText();
  channel.encoding = reader.TakeText();
  if (reader.failed()) return std::nullopt;
  return channel;
}

std::optional<McapMessage> ParseMessage(std::span<const std::uint8_t> content) {
  ByteReader reader(content);
  McapMessage message;
  message.channel = reader.Take<std::uint16_t>();
  (void)reader.Take<std::uint32_t>();  // sequence
  message.log_time_ns = reader.Take<std::uint64_t>();
  (void)reader.Take<std::uint64_t>();  // publish time
  message.bytes = reader.left();
  if (reader.failed()) return std::nullopt;
  return message;
}

std::optional<McapChunk> ParseChunk(std::span<const std::uint8_t> content) {
  ByteReader reader(content);
  McapChunk chunk;
  (void)reader.TakeBytes(16);  // times of the first and last message
  chunk.uncompressed_bytes = reader.Take<std::uint64_t>();
  chunk.uncompressed_crc = reader.Take<std::uint32_t>();
  chunk.compression = reader.TakeText();
  chunk.compressed_bytes = reader.Take<std::uint64_t>();
  if (reader.failed()) return std::nullopt;
  chunk.records = reader.left();
  if (chunk.records.size() > chunk.compressed_bytes) {
    chunk.records = chunk.records.first(static_cast<std::size_t>(chunk.compressed_bytes));
  }
  return chunk;
}

std::optional<McapStatistics> ParseStatistics(std::span<const std::uint8_t> content) {
  ByteReader reader(content);
  McapStatistics statistics;
  statistics.messages = reader.Take<std::uint64_t>();
  (void)reader.Take<std::uint16_t>();  // schemas
  statistics.channels = reader.Take<std::uint32_t>();
  (void)reader.TakeBytes(4 + 4 + 4);  // numbers of attachments, metadata, chunks
  statistics.message_start_ns = reader.Take<std::uint64_t>();
  statistics.message_end_ns = reader.Take<std::uint64_t>();
  ByteReader counts(reader.TakeBytes(reader.Take<std::uint32_t>()));
  while (!counts.left().empty() && !counts.failed()) {
    McapStatistics::Count& count = statistics.counts.emplace_back();
    count.channel = counts.Take<std::uint16_t>();
    count.messages = counts.Take<std::uint64_t>();
  }
  if (reader.failed() || counts.failed()) return std::nullopt;
  return statistics;
}

}  // namespace trailcast::bag
