#pragma once

#include <memory>

#include "services/base/ids.h"
#include "services/console/src/api/errand.h"
#include "services/fleet/draw.h"

namespace trailcast::console {

// This gets one picture of what a robot's camera sees, or null if the robot did not answer.
class LookErrand final : public ErrandFor<std::shared_ptr<const exchange::Snapshot>> {
 public:
  // By the exchange's rules, a repeated request waits for a second.
  static constexpr std::chrono::milliseconds kAskAgain{1000};
  static constexpr std::chrono::milliseconds kTimeout{2000};

  LookErrand(const AgentId& self, const AgentId& robot)
      : request_{.agent = robot, .client = self, .request = fleet::DrawNumber()} {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {request_}; }
  [[nodiscard]] std::chrono::milliseconds SayAgain() const override { return kAskAgain; }
  void Hear(const exchange::Message& message) override {
    const auto* snapshot = std::get_if<exchange::Snapshot>(&message);
    if (snapshot == nullptr || snapshot->agent != request_.agent) return;
    if (snapshot->client != request_.client || snapshot->request != request_.request) return;
    seen_ = std::make_shared<const exchange::Snapshot>(*snapshot);
  }
  [[nodiscard]] bool IsOver(std::chrono::milliseconds since) const override {
    return seen_ != nullptr || since >= kTimeout;
  }

 private:
  [[nodiscard]] Result<std::shared_ptr<const exchange::Snapshot>> Outcome() const override {
    return seen_;
  }

  exchange::SnapshotRequest request_;
  std::shared_ptr<const exchange::Snapshot> seen_;
};

}  // namespace trailcast::console
