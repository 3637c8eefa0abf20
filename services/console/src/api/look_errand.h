#pragma once

#include <memory>

#include "services/base/ids.h"
#include "services/console/src/api/errand.h"
#include "services/fleet/draw.h"

namespace trailcast::console {

// One picture of what a robot's camera sees; null: the robot did not answer.
class LookErrand final : public ErrandFor<std::shared_ptr<const exchange::Glance>> {
 public:
  // As the exchange's rules have it, who asks twice waits a second in between.
  static constexpr std::chrono::milliseconds kAskAgain{1000};
  static constexpr std::chrono::milliseconds kTimeout{2000};

  LookErrand(const AgentId& self, const AgentId& robot)
      : request_{.agent = robot, .client = self, .request = fleet::DrawNumber()} {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {request_}; }
  [[nodiscard]] std::chrono::milliseconds SayAgain() const override { return kAskAgain; }
  void Hear(const exchange::Message& message) override {
    const auto* glance = std::get_if<exchange::Glance>(&message);
    if (glance == nullptr || glance->agent != request_.agent) return;
    if (glance->client != request_.client || glance->request != request_.request) return;
    seen_ = std::make_shared<const exchange::Glance>(*glance);
  }
  [[nodiscard]] bool IsOver(std::chrono::milliseconds since) const override {
    return seen_ != nullptr || since >= kTimeout;
  }

 private:
  [[nodiscard]] Result<std::shared_ptr<const exchange::Glance>> Outcome() const override {
    return seen_;
  }

  exchange::GlanceRequest request_;
  std::shared_ptr<const exchange::Glance> seen_;
};

}  // namespace trailcast::console
