#pragma once

#include <optional>
#include <vector>

#include "agent/device/bag_device.h"
#include "services/bag/bag.h"

namespace trailcast::agent {

struct BagTopics {
  bag::Topic image;
  bool compressed = false;
  std::optional<bag::Topic> odometry;
  std::optional<bag::Topic> commands;  // if the run asks for them
};

// Chooses the topics that `run` names, or the only ones there are. kNotFound and kInvalidArgument
// say which topic is missing, unsuitable or ambiguous, and list the existing ones.
[[nodiscard]] Result<BagTopics> ChooseTopics(const std::vector<bag::Topic>& topics,
                                             const BagRun& run);

}  // namespace trailcast::agent
