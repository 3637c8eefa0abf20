#pragma once

#include <fstream>
#include <memory>

#include "services/bag/compression.h"
#include "services/bag/src/bag_file.h"
#include "services/bag/src/mcap_channels.h"

namespace trailcast::bag {

// An MCAP file of any writer: messages in chunks or by themselves, with a summary or, cut off,
// without. A summary that does not describe all that it counts counts for nothing. A chunk whose
// checksum or compression is wrong is left out; of one that is cut off, the beginning is read.
class McapFile final : public BagFile {
 public:
  [[nodiscard]] static Result<std::unique_ptr<McapFile>> Open(const std::filesystem::path& file);

  [[nodiscard]] Result<Contents> Survey(const Bag::Tell& tell) override;
  void Begin(const Topic& topic, std::chrono::nanoseconds from) override;
  [[nodiscard]] Result<std::optional<Message>> Next() override;

 private:
  McapFile(std::ifstream stream, std::filesystem::path file, std::uint64_t size)
      : stream_(std::move(stream)), file_(std::move(file)), size_(size) {}

  using Wanted = bool (McapFile::*)(const McapMessage& message) const;
  [[nodiscard]] Result<std::optional<McapMessage>> NextOf(Wanted wanted);
  [[nodiscard]] bool EndsBefore(std::uint64_t chunk_at);
  [[nodiscard]] bool IsOfTopic(const McapMessage& message) const;
  [[nodiscard]] bool IsAny(const McapMessage&) const { return true; }

  [[nodiscard]] std::optional<Contents> ReadSummary();
  [[nodiscard]] std::optional<RecordHead> ReadHead();
  [[nodiscard]] Result<Bytes> ReadAt(std::uint64_t at, std::uint64_t count);
  [[nodiscard]] std::optional<McapMessage> NextInChunk(Wanted wanted);
  [[nodiscard]] Result<bool> ReadRecord();
  void OpenChunk(std::span<const std::uint8_t> content, bool cut_off);
  void NoteDamageAt(const std::string& what);
  void NoteLacking();

  std::ifstream stream_;
  std::filesystem::path file_;
  std::uint64_t size_;
  std::uint64_t at_ = kMcapMagic.size();  // of the next record
  std::uint64_t record_ = 0;              // of the one that is read
  bool ended_ = false;
  std::uint64_t unpacked_ = 0;  // bytes, since it began
  std::uint64_t given_ = 0;     // messages, since it began
  bool damaged_ = false;        // something that was read since it began
  McapChannels channels_;
  Topic topic_;
  std::uint64_t from_ns_ = 0;
  Bytes chunk_;                             // records: a chunk's, decompressed, or a single one
  std::span<const std::uint8_t> in_chunk_;  // those left
};

}  // namespace trailcast::bag
