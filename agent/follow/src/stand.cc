#include "agent/follow/src/stand.h"

#include <utility>

namespace trailcast::agent {
namespace {

constexpr std::chrono::seconds kComesToStand{1};

}  // namespace

const ReplayStep* Stand::WithoutLooking(SensorTime stamp) const {
  return since_ && stamp - *since_ >= kComesToStand ? &wish_ : nullptr;
}

void Stand::Begin(const ReplayStep& step, SensorTime stamp) {
  if (!since_) since_ = stamp;
  wish_ = step;
  // These belong to the frame that was looked at, and not to those that are skipped.
  wish_.sight.searches.clear();
  wish_.sight.lost = {};
  wish_.decision.carried_left_m.reset();
}

ReplayStep StandingStep(ReplayStep step, ReplayState state, std::string reason) {
  step.command = {};
  step.state = state;
  step.evidence = Evidence::kNothing;
  step.reason = std::move(reason);
  return step;
}

}  // namespace trailcast::agent
