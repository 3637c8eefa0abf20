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

// The place where a simulated robot drives, as a command line names it.
struct SimulatedPlace {
  std::string world;            // a built-in place's name, or a world file (.obj, .glb, ...)
  std::filesystem::path path;   // way-points x_m,y_m; empty for the built-in place's own
  std::string up = "z";         // the vertical axis of a world file: y or z
  double scale = 1.0;           // metres per unit of a world file
  std::string ground = "mesh";  // the surface robots stand on: mesh or flat
};

// A circle of the world's plane with bumps that only wheels feel.
struct RoughGround {
  double x_m = 0.0;
  double y_m = 0.0;
  double radius_m = 1.0;
  double height_m = 0.01;  // RMS
};

// Somebody lifts a robot once it has driven so far and sets it down there, in the world's frame. No
// wheel turns meanwhile.
struct CarriedOff {
  double after_m = 0.0;
  motion::Pose2 to;
};

// A place in the world where a robot's battery charges, from empty to full in so many minutes.
struct Charger {
  double x_m = 0.0;
  double y_m = 0.0;
  double minutes = 0.0;
};

struct SimulatedRun {
  SimulatedPlace place;
  std::string camera = "webcam";  // a built-in camera's name, or a .toml file
  std::uint64_t seed = 1;         // for the robot's errors and all noise
  double speed_mps = 0.0;         // the scout's; 0 for the place's usual one
  bool drives_itself = false;     // a scout drives along the path; otherwise Drive commands it
  bool has_driver = false;        // a driver does the same whenever it is driven by hand
  bool stays_at_end = false;      // the scout keeps looking where its drive ended
  bool in_real_time = false;      // its time passes no faster than ours
  double rate_hz = 30.0;          // of its steps, each with odometry and a picture
  double turn_radius_m = 0.0;     // it steers like a car, no tighter than this; 0 for two driven
                                  // wheels
  // The file for the frames' true poses, for whoever judges the run: CSV `t_s,x_m,y_m,heading_rad`
  // in the world's frame. It may be empty.
  std::filesystem::path truth{};
  double battery_minutes = 0.0;  // how long a full one lasts; with 0 it reports none
  std::optional<Charger> charger{};
  std::vector<RoughGround> rough{};  // bumps in addition to the place's ground
  std::optional<CarriedOff> carried{};
};

class SimulatedRobot : public RobotDevice {
 public:
  // Says whether everything that SimulatedRun::truth asks for was written. Agents know this class
  // as a RobotDevice only.
  [[nodiscard]] virtual Result<void> TruthWritten() const = 0;
};

// Opens a robot from the library of simulated robots, which links a ray tracer and readers of world
// files that a real robot does not need. Errors: kUnavailable if it is not installed, and those of
// SimulatedDevice::Open.
[[nodiscard]] Result<std::unique_ptr<SimulatedRobot>> OpenSimulatedRobot(const SimulatedRun& run);

}  // namespace trailcast::agent

// The library exports this function.
extern "C" void trailcast_open_simulated_robot(
    const trailcast::agent::SimulatedRun& run,
    trailcast::Result<std::unique_ptr<trailcast::agent::SimulatedRobot>>& opened);
