// The library of simulated robots exports this function.
#include "services/lab/simulated/simulated_device.h"

extern "C" void trailcast_open_simulated_robot(
    const trailcast::agent::SimulatedRun& run,
    trailcast::Result<std::unique_ptr<trailcast::agent::SimulatedRobot>>& opened) {
  opened = trailcast::agent::SimulatedDevice::Open(run);
}
