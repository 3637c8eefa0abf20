#include "services/bag/src/mcap_channels.h"

namespace trailcast::bag {

bool McapChannels::Take(Opcode opcode, std::span<const std::uint8_t> content) {
  if (opcode == Opcode::kSchema) {
    if (auto schema = ParseSchema(content)) types_[schema->id] = std::move(schema->name);
    return true;
  }
  if (opcode != Opcode::kChannel) return false;
  auto channel = ParseChannel(content);
  if (!channel) return true;
  const auto type = types_.find(channel->schema);
  Topic& topic = channels_[channel->id];
  topic.name = std::move(channel->topic);
  topic.type = type == types_.end() ? std::string() : type->second;
  topic.encoding = std::move(channel->encoding);
  if (channel->schema != 0 && type == types_.end()) {
    without_schema_.insert(channel->id);
  } else {
    without_schema_.erase(channel->id);
  }
  return true;
}

const Topic* McapChannels::Find(std::uint16_t channel) const {
  const auto found = channels_.find(channel);
  return found == channels_.end() ? nullptr : &found->second;
}

bool McapChannels::Count(std::uint16_t channel, std::uint64_t messages) {
  const auto found = channels_.find(channel);
  if (found == channels_.end()) return false;
  found->second.messages += messages;
  return true;
}

std::uint64_t McapChannels::Counted(const Topic& topic) const {
  std::uint64_t messages = 0;
  for (const auto& [id, one] : channels_) {
    if (one.name == topic.name && one.type == topic.type) messages += one.messages;
  }
  return messages;
}

std::vector<Topic> McapChannels::Topics() const {
  std::vector<Topic> topics;
  for (const auto& [id, topic] : channels_) topics.push_back(topic);
  return topics;
}

}  // namespace trailcast::bag
