#include "services/lab/simulated/robot_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "services/base/number.h"
#include "services/base/time.h"

namespace trailcast::agent {
namespace {

using Kind = RobotFault::Kind;

struct FaultName {
  Kind kind;
  const char* name;
};
constexpr std::array kNames{FaultName{Kind::kCameraFreezes, "camera-freezes"},
                            FaultName{Kind::kCameraStops, "camera-stops"},
                            FaultName{Kind::kCameraClockBack, "camera-clock-back"},
                            FaultName{Kind::kCameraStampsStand, "camera-stamps-stand"},
                            FaultName{Kind::kOdometryStops, "odometry-stops"},
                            FaultName{Kind::kOdometryRestarts, "odometry-restarts"},
                            FaultName{Kind::kOdometryJumps, "odometry-jumps"},
                            FaultName{Kind::kOdometryClockBack, "odometry-clock-back"},
                            FaultName{Kind::kBaseStops, "base-stops"},
                            FaultName{Kind::kWheelSlips, "wheel-slips"}};

const char* NameOf(Kind kind) {
  return std::find_if(kNames.begin(), kNames.end(),
                      [&](const FaultName& each) { return each.kind == kind; })
      ->name;
}

std::optional<double> ParseSeconds(std::string_view text) {
  const auto seconds = ParseNumber<double>(text);
  return seconds && *seconds >= 0.0 ? seconds : std::nullopt;
}

std::optional<RobotFault> FaultOf(std::string_view text) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto name = std::find_if(kNames.begin(), kNames.end(), [&](const FaultName& each) {
    return each.name == text.substr(0, at);
  });
  const auto spell = ParseSpell(text.substr(at + 1));
  if (name == kNames.end() || !spell) return std::nullopt;
  return RobotFault{name->kind, *spell};
}

}  // namespace

std::optional<Spell> ParseSpell(std::string_view text) {
  Spell spell;
  const std::size_t plus = text.find('+');
  const auto after_s = ParseSeconds(text.substr(0, plus));
  if (!after_s) return std::nullopt;
  spell.after_s = *after_s;
  if (plus == std::string_view::npos) return spell;
  const auto for_s = ParseSeconds(text.substr(plus + 1));
  if (!for_s) return std::nullopt;
  spell.for_s = *for_s;
  return spell;
}

std::string RobotFaultNames() {
  std::string names;
  for (const FaultName& each : kNames)
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names;
}

Result<RobotFault> ParseRobotFault(const std::string& text) {
  if (const auto fault = FaultOf(text)) return *fault;
  return Fail(ErrorCode::kInvalidArgument,
              "'{}' is no fault: expected one of {}, each followed by @S, seconds after the robot "
              "was first told to drive, and by +S where it is over after so many seconds",
              text, RobotFaultNames());
}

RobotFaults::RobotFaults(const std::vector<RobotFault>& faults) {
  for (const RobotFault& fault : faults) entries_.push_back({fault});
}

void RobotFaults::DroveAt(Time now) {
  if (!drove_at_) drove_at_ = now;
}

std::optional<double> RobotFaults::SecondsDriven(Time now) const {
  return drove_at_ ? std::optional(Seconds(now - *drove_at_)) : std::nullopt;
}

std::vector<std::string> RobotFaults::Advance(Time now) {
  std::vector<std::string> begun;
  if (!drove_at_) return begun;
  for (Entry& entry : entries_) {
    entry.active = entry.fault.spell.contains(*SecondsDriven(now));
    if (!entry.active || entry.begun) continue;
    entry.begun = true;
    if (!first_began_at_) first_began_at_ = now;
    begun.emplace_back(NameOf(entry.fault.kind));
  }
  return begun;
}

bool RobotFaults::active(Kind kind) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& entry) { return entry.fault.kind == kind && entry.active; });
}

}  // namespace trailcast::agent
