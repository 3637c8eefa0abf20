#include "agent/follow/src/yielding.h"

#include <cmath>
#include <utility>

namespace trailcast::agent {

Spacing Yielding::SpacingFor(const ReplayStep& step, Time now) {
  const bool drives = step.command.linear_mps != 0.0;
  if (!enabled_ || !drives || !step.along_m) return {};
  return keep_distance_.Keep(*step.along_m, std::abs(step.command.linear_mps), neighbours_, now);
}

std::optional<ReplayStep> Yielding::StandOn(SensorTime stamp, Time now) {
  const ReplayStep* wish = stand_.WithoutLooking(stamp);
  if (wish == nullptr) return std::nullopt;
  const Spacing spacing = SpacingFor(*wish, now);
  if (!spacing.waits_for) return std::nullopt;
  return StandingStep(*wish, ReplayState::kYielding, WaitText(spacing, now));
}

ReplayStep Yielding::Apply(ReplayStep step, SensorTime stamp, Time now) {
  const Spacing spacing = SpacingFor(step, now);
  if (!spacing.waits_for) {
    stand_.End();
    step.command.linear_mps *= spacing.speed_factor;
    step.command.angular_radps *= spacing.speed_factor;
    return step;
  }
  stand_.Begin(step, stamp);
  return StandingStep(std::move(step), ReplayState::kYielding, WaitText(spacing, now));
}

}  // namespace trailcast::agent
