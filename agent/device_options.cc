#include "agent/device_options.h"

#include <spdlog/spdlog.h>

#include <utility>

namespace trailcast::agent {

void AddDeviceOptions(CLI::App& command, DeviceOptions& options, bool scout) {
  RecordedRun& recorded = options.recorded;
  SimulatedRun& simulated = options.simulated;
  simulated.drives_itself = scout;
  const std::string recording = "Recorded run";
  auto* frames = command.add_option("--frames", recorded.frames,
                                    "Folder of pictures (in the order of their names) or video");
  frames->group(recording);
  command
      .add_option("--odometry", recorded.odometry,
                  "CSV t_s,x_m,y_m,heading_rad, times counted from the first frame")
      ->needs(frames)
      ->group(recording);
  command
      .add_option("--rate", recorded.rate_hz, "Frames a second; default: the video's own, or 30")
      ->check(CLI::Range(0.1, 1000.0))
      ->needs(frames)
      ->group(recording);

  const std::string simulation = "Simulated robot";
  auto* world = command.add_option("--sim", simulated.place.world,
                                   "World: a built-in one's name, or a file (.obj, .glb, ...)");
  world->excludes(frames)->group(simulation);
  const auto add = [&](const std::string& flag, auto& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(world)->group(simulation);
  };
  add("--camera", simulated.camera, "Built-in camera's name, or a .toml file");
  add("--seed", simulated.seed, "Draws this robot's errors and noise");
  add("--path", simulated.place.path,
      "CSV x_m,y_m: the taught path; default: the built-in world's own");
  add("--up", simulated.place.up, "Axis that is up in a world file")
      ->check(CLI::IsMember({"y", "z"}));
  add("--scale", simulated.place.scale, "Metres per unit of a world file")
      ->check(CLI::PositiveNumber);
  add("--ground", simulated.place.ground, "What robots stand on")
      ->check(CLI::IsMember({"mesh", "flat"}));
  if (scout) {
    add("--speed", simulated.speed_mps,
        "How fast the scout is driven, m/s; default: the place's own")
        ->default_str("")
        ->check(CLI::Range(0.05, 2.0));
  }
  add("--sim-truth", options.truth, "Writes the true poses here, for a judge");
  command.callback([&options] {
    if (options.recorded.frames.empty() && !options.is_simulated()) {
      throw CLI::RequiredError("--frames or --sim");
    }
  });
}

Result<void> OpenedDevice::WriteTruth(const DeviceOptions& options) const {
  if (simulated == nullptr || options.truth.empty()) return {};
  return simulated->WriteTruth(options.truth);
}

Result<OpenedDevice> OpenDevice(const DeviceOptions& options) {
  OpenedDevice opened;
  if (options.is_simulated()) {
    auto device = SimulatedDevice::Open(options.simulated);
    if (!device) return tl::unexpected(device.error());
    opened.simulated = device->get();
    opened.device = std::move(*device);
    return opened;
  }
  auto device = RecordedDevice::Open(options.recorded);
  if (!device) return tl::unexpected(device.error());
  spdlog::info("{}, {:g} frames a second{}", (*device)->camera(), (*device)->rate_hz(),
               (*device)->has_odometry() ? ", with odometry" : ", no odometry: vision only");
  opened.device = std::move(*device);
  return opened;
}

}  // namespace trailcast::agent
