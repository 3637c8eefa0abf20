#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/simulated_robot.h"
#include "services/lab/simulated/scanner.h"

namespace trailcast::agent {

// A simulated robot in lockstep: the world's time passes only in Next, which in real time waits
// until it is due. The scout is driven along
// the path by an operator who sees where it is; a follower starts near the path's start (drawn by
// the seed) and does as it is told.
class SimulatedDevice final : public SimulatedRobot {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SimulatedDevice>> Open(const SimulatedRun& run);
  ~SimulatedDevice() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand& command) override;
  // A frame's time passes.
  [[nodiscard]] Result<image::GrayImage> Look() override;
  // The same as Next without a picture, for cameras that are slower than their base.
  [[nodiscard]] Observation NextBlind();
  // What a scanner above its axle sees where it is now.
  [[nodiscard]] motion::Scan Scan(const std::vector<Pillar>& pillars) const;
  // What a range sensor sees that is mounted there, seen from the axle.
  [[nodiscard]] motion::ConeRange Range(const motion::Pose2& mount,
                                        const std::vector<Pillar>& pillars) const;
  // As in sim::SimulatedRobot.
  void SetGrip(double left, double right);
  // Where SimulatedRun has a driver, that one drives it along the path.
  void ByHand(bool begins) override;
  [[nodiscard]] std::string camera() const override;
  [[nodiscard]] std::optional<double> drive_progress() const override;
  [[nodiscard]] std::optional<std::uint8_t> battery_percent() const override;

  [[nodiscard]] Result<void> TruthWritten() const override;

 private:
  struct State;
  explicit SimulatedDevice(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
