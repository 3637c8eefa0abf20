#include "agent/device/simulated_robot.h"

#include "services/base/module.h"

namespace trailcast::agent {

Result<std::unique_ptr<SimulatedRobot>> OpenSimulatedRobot(const SimulatedRun& run) {
  const auto symbol = FindInModule("libtrailcast_simulated.so", "trailcast_open_simulated_robot");
  if (!symbol) {
    return Fail(ErrorCode::kUnavailable,
                "this installation has no simulated robots, which real ones do not need: {}; the "
                "library lies beside the programs that './run build' makes, in the package "
                "trailcast-tools and in the image 'tools'",
                symbol.error().message);
  }
  Result<std::unique_ptr<SimulatedRobot>> opened;
  reinterpret_cast<decltype(&trailcast_open_simulated_robot)> (*symbol)(run, opened);
  return opened;
}

}  // namespace trailcast::agent
