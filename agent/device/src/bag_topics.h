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
  std::optional<bag::Topic> commands;  // where the run asks for them
};

// Those that `run` names, or that there is no other choice of. kNotFound, kInvalidArgument: what is
// missing, unfit or not clear; the message lists what there is.
[[nodiscard]] Result<BagTopics> ChooseTopics(const std::vector<bag::Topic>& topics,
                                             const BagRun& run);

}  // namespace trailcast::agent
