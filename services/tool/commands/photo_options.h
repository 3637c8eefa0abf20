#pragma once

#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/fleet/operator_peer.h"
#include "services/mission/orders.h"
#include "services/program/command_line.h"

namespace trailcast::tool {

// The photos that a mission takes on its way, as flags ask for them.
struct PhotoOptions {
  double every_m = 0.0;  // 0 for none
  std::vector<std::string> at{};
};
void AddPhotoOptions(CLI::App& app, PhotoOptions& options);

// Looks named places up in the network that servers keep, for which `peer` has the topics.
[[nodiscard]] Result<mission::PhotoWish> WishOf(const PhotoOptions& options,
                                                fleet::OperatorPeer& peer, double timeout_s);

}  // namespace trailcast::tool
