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
// until it is due. A scout is driven along the path by an operator who sees where it is. A follower
// starts near the path's start, as the seed draws it, and obeys commands.
class SimulatedDevice final : public SimulatedRobot {
 public:
  [[nodiscard]] static Result<std::unique_ptr<SimulatedDevice>> Open(const SimulatedRun& run);
  ~SimulatedDevice() override;

  [[nodiscard]] Result<std::optional<Observation>> Next() override;
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand& command) override;
  // The time of one frame passes.
  [[nodiscard]] Result<image::GrayImage> Look() override;
  // Does what Next does, without a picture, for cameras that are slower than their base.
  [[nodiscard]] Observation NextBlind();
  // Returns what a scanner above its axle sees now.
  [[nodiscard]] motion::Scan Scan(const std::vector<Pillar>& pillars) const;
  // Returns what a range sensor sees whose mount is given as seen from the axle.
  [[nodiscard]] motion::ConeRange Range(const motion::Pose2& mount,
                                        const std::vector<Pillar>& pillars) const;
  // See sim::SimulatedRobot.
  void SetGrip(double left, double right);
  // If SimulatedRun has a driver, that one drives it along the path.
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
