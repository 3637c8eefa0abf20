#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device.h"
#include "services/base/result.h"
#include "services/motion/motion.h"

namespace trailcast::agent {

// A SimulatedPlace is where a simulated robot drives, as a command line names it.
struct SimulatedPlace {
  std::string world;            // a built-in place's name, or a world file (.obj, .glb, ...)
  std::filesystem::path path;   // x_m,y_m way-points; empty: the built-in place's own
  std::string up = "z";         // of a world file: y or z
  double scale = 1.0;           // metres per unit of a world file
  std::string ground = "mesh";  // what robots stand on: mesh or flat
};

// RoughGround is a circle of the world's plane with bumps that only wheels feel.
struct RoughGround {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 1.0;
  double height_m = 0.01;  // RMS
};

// Somebody takes a robot up once it has driven so far, and sets it down there, in the world's
// frame: no wheel turns by that.
struct CarriedOff {
  double after_m = 0.0;
  motion::Pose2 to;
};

struct SimulatedRun {
  SimulatedPlace place;
  std::string camera = "webcam";  // a built-in camera's name, or a .toml file
  std::uint64_t seed = 1;         // draws the robot's errors and all noise
  double speed_mps = 0.0;         // the scout's; 0: as is usual in that place
  bool drives_itself = false;     // the scout, along the path; otherwise Drive says where to
  bool has_driver = false;        // who does the same whenever it is driven by hand
  bool stays_at_end = false;      // the scout goes on looking where its drive ended
  bool in_real_time = false;      // its time passes no faster than ours
  double rate_hz = 30.0;          // of its steps, each with odometry and a picture
  double turn_radius_m = 0.0;     // it steers like a car, no tighter; 0: by two driven wheels
  // For whoever judges: the true poses of the frames, as they are made, CSV
  // `t_s,x_m,y_m,heading_rad` in the world's frame. Empty: nowhere.
  std::filesystem::path truth{};
  double battery_minutes = 0.0;      // that a full one lasts; 0: it tells of none
  std::vector<RoughGround> rough{};  // what its wheels feel besides the place's ground
  std::optional<CarriedOff> carried{};
};

class SimulatedRobot : public RobotDevice {
 public:
  // Whether all of what SimulatedRun::truth asks for is there. Agents know this class as a
  // RobotDevice only.
  [[nodiscard]] virtual Result<void> TruthWritten() const = 0;
};

// From the library of simulated robots, which brings a ray tracer and readers of world files with
// it that a robot has no use for. Error: kUnavailable where it is not installed; those of
// SimulatedDevice::Open.
[[nodiscard]] Result<std::unique_ptr<SimulatedRobot>> OpenSimulatedRobot(const SimulatedRun& run);

}  // namespace trailcast::agent

// What that library exports under this name.
extern "C" void trailcast_open_simulated_robot(
    const trailcast::agent::SimulatedRun& run,
    trailcast::Result<std::unique_ptr<trailcast::agent::SimulatedRobot>>& opened);
