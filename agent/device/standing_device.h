#pragma once

#include <string>
#include <vector>

#include "agent/device/device.h"

namespace trailcast::agent {

// A robot that looks and does not move: whatever it is told to drive, it is told to stand.
class StandingDevice : public RobotDevice {
 public:
  explicit StandingDevice(RobotDevice& device) : device_(device) {}

  [[nodiscard]] Result<std::optional<Observation>> Next() override { return device_.Next(); }
  [[nodiscard]] Result<void> Drive(const motion::VelocityCommand& /*command*/) override {
    return device_.Drive({});
  }
  void OnTrouble(const Trouble& tell) override { device_.OnTrouble(tell); }
  [[nodiscard]] Result<image::GrayImage> Look() override { return device_.Look(); }
  [[nodiscard]] std::string Ailment() override { return device_.Ailment(); }
  [[nodiscard]] std::vector<std::string> TakeNews() override { return device_.TakeNews(); }
  [[nodiscard]] std::string camera() const override { return device_.camera(); }
  [[nodiscard]] std::optional<double> drive_progress() const override {
    return device_.drive_progress();
  }
  [[nodiscard]] std::optional<std::uint8_t> battery_percent() const override {
    return device_.battery_percent();
  }

 private:
  RobotDevice& device_;
};

}  // namespace trailcast::agent
