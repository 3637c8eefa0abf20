#pragma once

#include <fstream>
#include <memory>

#include "services/bag/compression.h"
#include "services/bag/src/bag_file.h"
#include "services/bag/src/mcap_channels.h"

namespace trailcast::bag {

// An MCAP file of any writer. Its messages may be in chunks or by themselves, and it may lack its
// summary because it was cut off. A summary that does not describe all that it counts is ignored. A
// chunk with a wrong checksum or compression is left out. If a chunk is cut off, its beginning is
// read.
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
  std::uint64_t at_ = kMcapMagic.size();  // where the next record begins
  std::uint64_t record_ = 0;              // where the current record begins
  bool ended_ = false;
  std::uint64_t unpacked_ = 0;  // bytes, since reading began
  std::uint64_t given_ = 0;     // messages, since reading began
  bool damaged_ = false;        // damage was found since reading began
  McapChannels channels_;
  Topic topic_;
  std::uint64_t from_ns_ = 0;
  Bytes chunk_;                             // records: a decompressed chunk's, or a single one
  std::span<const std::uint8_t> in_chunk_;  // the part not read yet
};

}  // namespace trailcast::bag
