#pragma once

#include <map>
#include <set>
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
  [[nodiscard]] std::size_t size() const { return channels_.size(); }
  // That the schema of each channel that names one is known.
  [[nodiscard]] bool HasAllSchemas() const { return without_schema_.empty(); }

  // False: nobody has described that channel.
  bool Count(std::uint16_t channel, std::uint64_t messages);
  // How many messages of the topic were counted.
  [[nodiscard]] std::uint64_t Counted(const Topic& topic) const;
  // One for each channel.
  [[nodiscard]] std::vector<Topic> Topics() const;

 private:
  std::map<std::uint16_t, std::string> types_;  // of schemas
  std::map<std::uint16_t, Topic> channels_;
  std::set<std::uint16_t> without_schema_;  // channels that name one that is not known
};

}  // namespace trailcast::bag
