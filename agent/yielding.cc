#include "agent/yielding.h"

#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

constexpr std::chrono::seconds kComesToStand{1};

ReplayStep Stand(ReplayStep step, const Spacing& spacing, KeepDistance::Time now) {
  step.command = {};
  step.state = ReplayState::kYielding;
  step.reason = WaitText(spacing, now);
  return step;
}

}  // namespace

Spacing Yielding::SpacingFor(const ReplayStep& step, Time now) {
  const bool drives = step.command.linear_mps != 0.0;
  if (!enabled_ || !drives || !step.along_m) return {};
  return keep_distance_.Keep(*step.along_m, std::abs(step.command.linear_mps), neighbours_, now);
}

std::optional<ReplayStep> Yielding::StandOn(SensorTime stamp, Time now) {
  if (!since_ || stamp - *since_ < kComesToStand) return std::nullopt;
  const Spacing spacing = SpacingFor(wish_, now);
  if (!spacing.waits_for) return std::nullopt;
  return Stand(wish_, spacing, now);
}

ReplayStep Yielding::Apply(ReplayStep step, SensorTime stamp, Time now) {
  const Spacing spacing = SpacingFor(step, now);
  if (!spacing.waits_for) {
    since_.reset();
    step.command.linear_mps *= spacing.speed_factor;
    step.command.angular_radps *= spacing.speed_factor;
    return step;
  }
  if (!since_) since_ = stamp;
  wish_ = step;
  // Of the frame that was looked at, and not of those that are not.
  wish_.sight.searches.clear();
  wish_.sight.lost = {};
  wish_.decision.carried_left_m.reset();
  return Stand(std::move(step), spacing, now);
}

}  // namespace trailcast::agent
