#include "services/bag/src/mcap_file.h"

#include <algorithm>
#include <limits>

#include "services/bag/src/byte_reader.h"
#include "services/bag/src/crc32.h"

namespace trailcast::bag {
namespace {

// A larger piece is damage; no known writer makes one.
constexpr std::uint64_t kMostChunkBytes = std::uint64_t{100} << 20U;
constexpr std::uint64_t kMostSummaryBytes = std::uint64_t{100} << 20U;
constexpr std::uint64_t kFooterBytes = 20;

std::chrono::nanoseconds Time(std::uint64_t ns) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::int64_t>::max();
  return std::chrono::nanoseconds(static_cast<std::int64_t>(std::min(ns, kMost)));
}

// Returns the record at the beginning of `bytes`, and removes it from them, or nothing if it is not
// whole.
struct Record {
  Opcode opcode{};
  std::span<const std::uint8_t> content;
};
std::optional<Record> TakeRecord(std::span<const std::uint8_t>& bytes) {
  const auto head = ParseRecordHead(bytes);
  if (!head || head->length > bytes.size() - kRecordHeadBytes) return std::nullopt;
  const auto length = static_cast<std::size_t>(head->length);
  const Record record{head->opcode, bytes.subspan(kRecordHeadBytes, length)};
  bytes = bytes.subspan(kRecordHeadBytes + length);
  return record;
}

// Counts the messages of all channels. Returns false if a channel, its schema or its messages are
// not described, so that only reading the whole file tells its contents. Writers may leave anything
// out of a summary.
bool Explains(McapChannels& channels, const McapStatistics& statistics) {
  std::uint64_t messages = 0;
  for (const auto& count : statistics.counts) {
    if (!channels.Count(count.channel, count.messages)) return false;
    messages += count.messages;
  }
  return channels.HasAllSchemas() && channels.size() == statistics.channels &&
         messages == statistics.messages;
}

}  // namespace

Result<std::unique_ptr<McapFile>> McapFile::Open(const std::filesystem::path& file) {
  std::error_code failed;
  const std::uint64_t size = std::filesystem::file_size(file, failed);
  std::ifstream stream(file, std::ios::binary);
  if (failed || !stream) {
    return Fail(ErrorCode::kNotFound, "cannot read {}", file.string());
  }
  return std::unique_ptr<McapFile>(new McapFile(std::move(stream), file, size));
}

Result<Bytes> McapFile::ReadAt(std::uint64_t at, std::uint64_t count) {
  Bytes bytes(static_cast<std::size_t>(count));
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(at));
  stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream_) {
    return Fail(ErrorCode::kUnavailable, "{} cannot be read at byte {}: is its disk damaged?",
                file_.string(), at);
  }
  return bytes;
}

void McapFile::NoteDamageAt(const std::string& what) {
  damaged_ = true;
  NoteDamage(fmt::format("at byte {}: {}", record_, what));
}

// Notes that messages are missing if the file lists more of the topic than it had and no damage
// explains that.
void McapFile::NoteLacking() {
  const std::uint64_t listed = channels_.Counted(topic_);
  if (damaged_ || from_ns_ != 0 || given_ >= listed) return;
  NoteDamage(fmt::format("its list of contents has {} messages of {}, of which {} are there",
                         listed, topic_.name, given_));
}

// Returns the list of contents at the file's end if it is whole.
std::optional<Contents> McapFile::ReadSummary() {
  const std::uint64_t ending = kRecordHeadBytes + kFooterBytes + kMcapMagic.size();
  if (size_ < kMcapMagic.size() + ending) return std::nullopt;
  const std::uint64_t footer_at = size_ - ending;
  const auto tail = ReadAt(footer_at, ending);
  if (!tail || !std::equal(kMcapMagic.begin(), kMcapMagic.end(), tail->end() - kMcapMagic.size())) {
    return std::nullopt;
  }
  std::span<const std::uint8_t> left(*tail);
  const auto footer = TakeRecord(left);
  if (!footer || footer->opcode != Opcode::kFooter) return std::nullopt;
  ByteReader fields(footer->content);
  const auto begins = fields.Take<std::uint64_t>();
  (void)fields.Take<std::uint64_t>();  // where the table of the summary's groups begins
  const auto crc = fields.Take<std::uint32_t>();
  if (begins < kMcapMagic.size() || begins >= footer_at || footer_at - begins > kMostSummaryBytes) {
    return std::nullopt;
  }
  // The checksum covers everything before its own field; 0 means that there is none.
  const std::uint64_t checked = size_ - kMcapMagic.size() - sizeof(crc) - begins;
  const auto summary = ReadAt(begins, checked);
  if (!summary || (crc != 0 && Crc32(*summary) != crc)) return std::nullopt;
  McapChannels channels;
  std::optional<McapStatistics> statistics;
  left = std::span(*summary).first(static_cast<std::size_t>(footer_at - begins));
  while (const auto record = TakeRecord(left)) {
    if (channels.Take(record->opcode, record->content)) continue;
    if (record->opcode == Opcode::kStatistics) statistics = ParseStatistics(record->content);
  }
  if (!left.empty() || !statistics || !Explains(channels, *statistics)) return std::nullopt;
  channels_ = channels;
  return Contents{channels.Topics(), Time(statistics->message_start_ns),
                  Time(statistics->message_end_ns)};
}

Result<Contents> McapFile::Survey(const Bag::Tell& tell) {
  if (auto contents = ReadSummary()) return *contents;
  tell(fmt::format("{} has no whole list of contents (was it cut off?): reading all of it",
                   file_.string()));
  Begin({}, {});
  std::optional<std::chrono::nanoseconds> first;
  std::chrono::nanoseconds last{};
  while (true) {
    const auto message = NextOf(&McapFile::IsAny);
    if (!message) return tl::unexpected(message.error());
    if (!*message) break;
    channels_.Count((*message)->channel, 1);
    if (!first) first = Time((*message)->log_time_ns);
    last = std::max(last, Time((*message)->log_time_ns));
  }
  return Contents{channels_.Topics(), first.value_or(std::chrono::nanoseconds(0)), last};
}

void McapFile::Begin(const Topic& topic, std::chrono::nanoseconds from) {
  topic_ = topic;
  from_ns_ = static_cast<std::uint64_t>(std::max<std::int64_t>(from.count(), 0));
  at_ = kMcapMagic.size();
  ended_ = false;
  unpacked_ = 0;
  given_ = 0;
  damaged_ = false;
  in_chunk_ = {};
}

bool McapFile::IsOfTopic(const McapMessage& message) const {
  const Topic* topic = channels_.Find(message.channel);
  return topic != nullptr && topic->name == topic_.name && topic->type == topic_.type &&
         message.log_time_ns >= from_ns_;
}

// The chunk's head tells the times of its messages.
bool McapFile::EndsBefore(std::uint64_t chunk_at) {
  if (from_ns_ == 0) return false;
  const auto times = ReadAt(chunk_at, 2 * sizeof(std::uint64_t));
  if (!times) return false;
  ByteReader reader(*times);
  (void)reader.Take<std::uint64_t>();  // of the first message
  return reader.Take<std::uint64_t>() < from_ns_;
}

std::optional<RecordHead> McapFile::ReadHead() {
  record_ = at_;
  const std::uint64_t left = size_ - at_;
  const auto bytes = ReadAt(at_, std::min<std::uint64_t>(left, kRecordHeadBytes));
  const auto head = bytes ? ParseRecordHead(*bytes) : std::nullopt;
  if (!head) NoteDamageAt("the file is cut off here");
  return head;
}

std::optional<McapMessage> McapFile::NextInChunk(Wanted wanted) {
  while (!in_chunk_.empty()) {
    const auto record = TakeRecord(in_chunk_);
    if (!record) {
      NoteDamageAt("a chunk's last record is not whole");
      in_chunk_ = {};
      break;
    }
    if (channels_.Take(record->opcode, record->content)) continue;
    if (record->opcode != Opcode::kMessage) continue;
    const auto message = ParseMessage(record->content);
    if (message && (this->*wanted)(*message)) return message;
  }
  return std::nullopt;
}

void McapFile::OpenChunk(std::span<const std::uint8_t> content, bool cut_off) {
  const auto chunk = ParseChunk(content);
  const auto compression = chunk ? FindCompression(chunk->compression) : std::nullopt;
  if (!chunk || chunk->uncompressed_bytes > kMostChunkBytes) {
    NoteDamageAt("a chunk that is none");
    return;
  }
  if (!compression) {
    NoteDamageAt(fmt::format("a chunk compressed by '{}': expected lz4, zstd or nothing",
                             chunk->compression.substr(0, 20)));
    return;
  }
  unpacked_ += chunk->uncompressed_bytes;
  if (!MayUnpack(unpacked_, size_)) {
    NoteDamageAt("all that is packed here is far too much: the rest is left out");
    ended_ = true;
    return;
  }
  Decompressed records = Decompress(*compression, chunk->records, chunk->uncompressed_bytes);
  const bool sound =
      records.whole && records.bytes.size() == chunk->uncompressed_bytes &&
      (chunk->uncompressed_crc == 0 || Crc32(records.bytes) == chunk->uncompressed_crc);
  if (!cut_off && !sound) {
    NoteDamageAt("a damaged chunk, left out");
    return;
  }
  chunk_ = std::move(records.bytes);
  in_chunk_ = chunk_;
}

// Reads the file's next record; NextInChunk then reads its messages. Returns false at the end.
Result<bool> McapFile::ReadRecord() {
  if (ended_) return false;
  const auto head = ReadHead();
  ended_ = !head || head->opcode == Opcode::kDataEnd || head->opcode == Opcode::kFooter;
  if (ended_) return false;
  const std::uint64_t left = size_ - record_ - kRecordHeadBytes;
  const std::uint64_t length = std::min(head->length, left);
  const bool cut_off = head->length > left;
  if (cut_off) NoteDamageAt("the file is cut off within this record");
  at_ = record_ + kRecordHeadBytes + length;
  const bool chunk = head->opcode == Opcode::kChunk;
  const bool whole =
      !cut_off && (head->opcode == Opcode::kMessage || head->opcode == Opcode::kSchema ||
                   head->opcode == Opcode::kChannel);
  if (!chunk && !whole) return true;
  if (chunk && EndsBefore(record_ + kRecordHeadBytes)) return true;
  if (length > (chunk ? kMostChunkBytes : kMostMessageBytes)) {
    NoteDamageAt(fmt::format("a record of {} bytes, left out", length));
    return true;
  }
  auto bytes = ReadAt(record_, kRecordHeadBytes + length);
  if (!bytes) return tl::unexpected(bytes.error());
  if (chunk) {
    OpenChunk(std::span(*bytes).subspan(kRecordHeadBytes), cut_off);
  } else {
    chunk_ = std::move(*bytes);
    in_chunk_ = chunk_;
  }
  return true;
}

Result<std::optional<McapMessage>> McapFile::NextOf(Wanted wanted) {
  while (true) {
    if (const auto message = NextInChunk(wanted)) return message;
    const auto more = ReadRecord();
    if (!more) return tl::unexpected(more.error());
    if (!*more) return std::nullopt;
  }
}

Result<std::optional<Message>> McapFile::Next() {
  const auto message = NextOf(&McapFile::IsOfTopic);
  if (!message) return tl::unexpected(message.error());
  if (!*message) {
    NoteLacking();
    return std::nullopt;
  }
  ++given_;
  return Message{Time((*message)->log_time_ns), (*message)->bytes};
}

}  // namespace trailcast::bag
