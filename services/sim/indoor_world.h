#pragma once

#include <memory>

#include "services/base/result.h"
#include "services/sim/path.h"
#include "services/sim/world.h"

namespace trailcast::sim {

struct BuiltInWorld {
  std::shared_ptr<const World> world;
  DrivenPath path;  // the way-points that a scout is driven along
};

// `indoor`: two furnished laboratory rooms of 12 m x 9 m in all, joined by a wide doorway, with a
// path of 15 m that turns from one into the other. Always the same; takes about a second to make.
[[nodiscard]] Result<BuiltInWorld> MakeIndoorWorld();

}  // namespace trailcast::sim
