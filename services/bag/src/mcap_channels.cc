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
  return true;
}

const Topic* McapChannels::Find(std::uint16_t channel) const {
  const auto found = channels_.find(channel);
  return found == channels_.end() ? nullptr : &found->second;
}

void McapChannels::Count(std::uint16_t channel, std::uint64_t messages) {
  const auto found = channels_.find(channel);
  if (found != channels_.end()) found->second.messages += messages;
}

std::vector<Topic> McapChannels::Topics() const {
  std::vector<Topic> topics;
  for (const auto& [id, topic] : channels_) topics.push_back(topic);
  return topics;
}

}  // namespace trailcast::bag
