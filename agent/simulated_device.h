#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "agent/device.h"
#include "services/sim/place.h"

namespace trailcast::agent {

struct SimulatedRun {
  sim::PlaceOptions place;
  std::string camera = "webcam";  // a built-in camera's name, or a .toml file
  std::uint64_t seed = 1;         // draws the robot's errors and all noise
  double speed_mps = 0.0;         // the scout's; 0: as is usual in that place
  bool drives_itself = false;     // the scout, along the path; otherwise Drive says where to
  bool stays_at_end = false;      // the scout goes on looking where its drive ended
};

// A simulated robot in lockstep: the world's time passes only in Next. The scout is driven along
// the path by an operator who sees where it is; a follower starts near the path's start (drawn by
// the seed) and does as it is told.
class SimulatedDevice final : public RobotDevice {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SimulatedDevice>> Open(const SimulatedRun& run);
  ~SimulatedDevice() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand& command) override;
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override;

  // For whoever judges: the true poses of the frames so far, CSV `t_s,x_m,y_m,heading_rad` in the
  // world's frame. Agents know this class as a RobotDevice only.
  [[nodiscard]] Result<void> WriteTruth(const std::filesystem::path& file) const;

 private:
  struct State;
  explicit SimulatedDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
