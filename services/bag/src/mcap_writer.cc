#include "services/bag/mcap_writer.h"

#include <algorithm>
#include <concepts>

#include "services/bag/src/crc32.h"
#include "services/bag/src/mcap_format.h"

namespace trailcast::bag {
namespace {

constexpr std::size_t kUsualBytes = 128;
constexpr std::size_t kFullChunkBytes = std::size_t{1} << 20U;

// Builds the content of a record, little-endian.
class Content {
 public:
  Content() { bytes_.reserve(kUsualBytes); }
  template <std::unsigned_integral Number>
  Content& Put(Number number) {
    for (std::size_t i = 0; i < sizeof(Number); ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8U * i)));
    }
    return *this;
  }
  Content& PutBytes(std::span<const std::uint8_t> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  Content& PutText(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  // Puts the number of bytes, in four, before them.
  Content& PutCounted(std::span<const std::uint8_t> bytes) {
    return Put(static_cast<std::uint32_t>(bytes.size())).PutBytes(bytes);
  }
  [[nodiscard]] const Bytes& bytes() const { return bytes_; }
  [[nodiscard]] Bytes As(Opcode opcode) const {
    Content record;
    record.Put(static_cast<std::uint8_t>(opcode)).Put(std::uint64_t{bytes_.size()});
    return record.PutBytes(bytes_).bytes();
  }

 private:
  Bytes bytes_;
};

void AppendTo(Bytes& bytes, const Bytes& record) {
  bytes.insert(bytes.end(), record.begin(), record.end());
}

}  // namespace

void McapWriter::Times::Add(std::uint64_t at_ns) {
  first_ns = messages == 0 ? at_ns : std::min(first_ns, at_ns);
  last_ns = std::max(last_ns, at_ns);
  ++messages;
}

McapWriter::McapWriter(Compression compression, std::string_view profile)
    : compression_(compression) {
  Append({kMcapMagic.begin(), kMcapMagic.end()});
  Append(Content().PutText(profile).PutText("trailcast").As(Opcode::kHeader));
}

void McapWriter::Append(const Bytes& record) {
  AppendTo(bytes_, record);
  offset_ += record.size();
}

McapWriter::Id McapWriter::AddSchema(std::string_view name, std::string_view encoding,
                                     std::span<const std::uint8_t> description) {
  const Id id = ++schemas_;
  const Bytes record =
      Content().Put(id).PutText(name).PutText(encoding).PutCounted(description).As(Opcode::kSchema);
  AppendTo(chunk_, record);
  AppendTo(descriptions_, record);
  return id;
}

McapWriter::Id McapWriter::AddChannel(Id schema, std::string_view topic,
                                      std::string_view message_encoding) {
  const Id id = static_cast<Id>(messages_.size() + 1);
  messages_[id] = 0;
  const Bytes record = Content()
                           .Put(id)
                           .Put(schema)
                           .PutText(topic)
                           .PutText(message_encoding)
                           .PutCounted({})  // metadata
                           .As(Opcode::kChannel);
  AppendTo(chunk_, record);
  AppendTo(descriptions_, record);
  return id;
}

void McapWriter::Put(Id channel, std::chrono::nanoseconds at, std::span<const std::uint8_t> bytes) {
  const auto at_ns = static_cast<std::uint64_t>(at.count());
  places_[channel].push_back({at_ns, chunk_.size()});
  AppendTo(chunk_, Content()
                       .Put(channel)
                       .Put(messages_[channel]++)
                       .Put(at_ns)
                       .Put(at_ns)
                       .PutBytes(bytes)
                       .As(Opcode::kMessage));
  in_chunk_.Add(at_ns);
  in_file_.Add(at_ns);
  if (chunk_.size() >= kFullChunkBytes) EndChunk();
}

// Returns where in the file the index of each channel's messages is.
std::map<McapWriter::Id, std::uint64_t> McapWriter::AppendIndexes() {
  std::map<Id, std::uint64_t> offsets;
  for (const auto& [channel, places] : places_) {
    offsets[channel] = offset_;
    Content entries;
    for (const Place& place : places) entries.Put(place.at_ns).Put(place.offset);
    Append(Content().Put(channel).PutCounted(entries.bytes()).As(Opcode::kMessageIndex));
  }
  return offsets;
}

void McapWriter::EndChunk() {
  if (in_chunk_.messages == 0) return;
  const Bytes records = Compress(compression_, chunk_);
  const std::uint64_t chunk_at = offset_;
  Append(Content()
             .Put(in_chunk_.first_ns)
             .Put(in_chunk_.last_ns)
             .Put(std::uint64_t{chunk_.size()})
             .Put(Crc32(chunk_))
             .PutText(NameOf(compression_))
             .Put(std::uint64_t{records.size()})
             .PutBytes(records)
             .As(Opcode::kChunk));
  const std::uint64_t chunk_ends = offset_;
  Content offsets;
  for (const auto& [channel, offset] : AppendIndexes()) offsets.Put(channel).Put(offset);
  AppendTo(chunk_indexes_, Content()
                               .Put(in_chunk_.first_ns)
                               .Put(in_chunk_.last_ns)
                               .Put(chunk_at)
                               .Put(chunk_ends - chunk_at)
                               .PutCounted(offsets.bytes())
                               .Put(offset_ - chunk_ends)
                               .PutText(NameOf(compression_))
                               .Put(std::uint64_t{records.size()})
                               .Put(std::uint64_t{chunk_.size()})
                               .As(Opcode::kChunkIndex));
  ++chunks_;
  chunk_.clear();
  places_.clear();
  in_chunk_ = {};
}

void McapWriter::End() {
  EndChunk();
  Append(Content().Put(std::uint32_t{0}).As(Opcode::kDataEnd));  // 0 stands for no checksum
  const std::uint64_t summary_at = offset_;
  Append(descriptions_);
  Content counts;
  for (const auto& [channel, messages] : messages_) {
    counts.Put(channel).Put(std::uint64_t{messages});
  }
  Append(Content()
             .Put(in_file_.messages)
             .Put(schemas_)
             .Put(static_cast<std::uint32_t>(messages_.size()))
             .Put(std::uint32_t{0})  // attachments
             .Put(std::uint32_t{0})  // metadata
             .Put(chunks_)
             .Put(in_file_.first_ns)
             .Put(in_file_.last_ns)
             .PutCounted(counts.bytes())
             .As(Opcode::kStatistics));
  Append(chunk_indexes_);
  // The footer has no table of the summary's groups and no checksum.
  Append(Content().Put(summary_at).Put(std::uint64_t{0}).Put(std::uint32_t{0}).As(Opcode::kFooter));
  Append({kMcapMagic.begin(), kMcapMagic.end()});
}

}  // namespace trailcast::bag
