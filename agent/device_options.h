#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "agent/recorded_device.h"
#include "agent/simulated_device.h"

namespace trailcast::agent {

// Which robot is behind the agent, as the command line says it.
struct DeviceOptions {
  RecordedRun recorded;
  SimulatedRun simulated;
  std::filesystem::path truth;  // where a simulated robot's true poses go; empty: nowhere

  [[nodiscard]] bool is_simulated() const { return !simulated.place.world.empty(); }
};

// Flags of `command`; one of --frames and --sim is required. The scout's differ in that it may be
// told a path and a speed.
void AddDeviceOptions(CLI::App& command, DeviceOptions& options, bool scout);

struct OpenedDevice {
  std::unique_ptr<RobotDevice> device;
  const SimulatedDevice* simulated = nullptr;  // the same, where it is one

  // Writes what `options` asks for after the run.
  [[nodiscard]] Result<void> WriteTruth(const DeviceOptions& options) const;
};

[[nodiscard]] Result<OpenedDevice> OpenDevice(const DeviceOptions& options);

}  // namespace trailcast::agent
