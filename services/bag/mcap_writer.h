#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "services/bag/compression.h"

namespace trailcast::bag {

// Makes an MCAP file's bytes from its first to its last, in chunks with an index. Players can
// therefore seek in it, and a file that was cut off loses only its last chunk. It uses no disk and
// no clock.
class McapWriter {
 public:
  using Id = std::uint16_t;

  McapWriter(Compression compression, std::string_view profile);

  // `encoding` and `description` follow the MCAP registry ("protobuf", a FileDescriptorSet).
  Id AddSchema(std::string_view name, std::string_view encoding,
               std::span<const std::uint8_t> description);
  Id AddChannel(Id schema, std::string_view topic, std::string_view message_encoding);
  // `at` must not be negative.
  void Put(Id channel, std::chrono::nanoseconds at, std::span<const std::uint8_t> bytes);
  // Ends the chunk that is being filled. Chunks also end by themselves, at a megabyte.
  void EndChunk();
  // Ends the file; nothing may be put after it.
  void End();

  // Returns the bytes made since the last call.
  [[nodiscard]] Bytes TakeBytes() { return std::exchange(bytes_, {}); }

 private:
  struct Times {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    std::uint64_t messages = 0;
    void Add(std::uint64_t at_ns);
  };
  struct Place {
    std::uint64_t at_ns = 0;
    std::uint64_t offset = 0;  // in the chunk
  };

  void Append(const Bytes& record);
  std::map<Id, std::uint64_t> AppendIndexes();

  Compression compression_;
  Bytes bytes_;
  std::uint64_t offset_ = 0;  // of the file's next byte
  Bytes chunk_;               // records
  Times in_chunk_;
  std::map<Id, std::vector<Place>> places_;  // of the chunk's messages
  Bytes descriptions_;                       // schemas and channels, to repeat in the summary
  Bytes chunk_indexes_;
  std::uint32_t chunks_ = 0;
  Id schemas_ = 0;
  std::map<Id, std::uint32_t> messages_;  // of each channel
  Times in_file_;
};

}  // namespace trailcast::bag
