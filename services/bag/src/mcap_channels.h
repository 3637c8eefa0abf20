#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/bag/bag.h"
#include "services/bag/src/mcap_format.h"

namespace trailcast::bag {

// Knows an MCAP file's schemas and channels, and so the topic of a message.
class McapChannels {
 public:
  // Takes a record. Returns true if `opcode` is a schema or a channel, even if a damaged one was
  // passed over.
  bool Take(Opcode opcode, std::span<const std::uint8_t> content);

  // Returns name, type and encoding, or nullptr for a channel that was not described.
  [[nodiscard]] const Topic* Find(std::uint16_t channel) const;
  [[nodiscard]] std::size_t size() const { return channels_.size(); }
  // Says whether the schema of each channel that names one is known.
  [[nodiscard]] bool HasAllSchemas() const { return without_schema_.empty(); }

  // Counts messages; returns false if the channel was not described.
  bool Count(std::uint16_t channel, std::uint64_t messages);
  // Returns how many messages of the topic were counted.
  [[nodiscard]] std::uint64_t Counted(const Topic& topic) const;
  // Returns one topic for each channel.
  [[nodiscard]] std::vector<Topic> Topics() const;

 private:
  std::map<std::uint16_t, std::string> types_;  // of schemas
  std::map<std::uint16_t, Topic> channels_;
  std::set<std::uint16_t> without_schema_;  // channels that name an unknown one
};

}  // namespace trailcast::bag
