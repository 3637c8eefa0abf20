#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/bag/bag.h"
#include "services/bag/src/mcap_format.h"

namespace trailcast::bag {

// What an MCAP file's schemas and channels say: which topic a message is of.
class McapChannels {
 public:
  // True: `opcode` is a schema or a channel, and was taken in or, damaged, passed over.
  bool Take(Opcode opcode, std::span<const std::uint8_t> content);

  // Its name, type and encoding; nullptr for a channel that nobody has described.
  [[nodiscard]] const Topic* Find(std::uint16_t channel) const;
  [[nodiscard]] bool empty() const { return channels_.empty(); }

  void Count(std::uint16_t channel, std::uint64_t messages);
  // One for each channel.
  [[nodiscard]] std::vector<Topic> Topics() const;

 private:
  std::map<std::uint16_t, std::string> types_;  // of schemas
  std::map<std::uint16_t, Topic> channels_;
};

}  // namespace trailcast::bag
