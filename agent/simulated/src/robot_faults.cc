#include "agent/simulated/robot_faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

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

// All of the text is a number of seconds.
std::optional<double> ParseSeconds(std::string_view text) {
  double seconds = 0.0;
  const char* end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, seconds);
  if (error != std::errc{} || next != end || !(seconds >= 0.0)) return std::nullopt;
  return seconds;
}

std::optional<RobotFault> Parse(std::string_view text) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos) return std::nullopt;
  const auto name = std::find_if(kNames.begin(), kNames.end(), [&](const FaultName& each) {
    return each.name == text.substr(0, at);
  });
  std::string_view times = text.substr(at + 1);
  RobotFault fault;
  if (const std::size_t plus = times.find('+'); plus != std::string_view::npos) {
    const auto for_s = ParseSeconds(times.substr(plus + 1));
    if (!for_s) return std::nullopt;
    fault.for_s = *for_s;
    times = times.substr(0, plus);
  }
  const auto after_s = ParseSeconds(times);
  if (name == kNames.end() || !after_s) return std::nullopt;
  fault.kind = name->kind;
  fault.after_s = *after_s;
  return fault;
}

}  // namespace

std::string RobotFaultNames() {
  std::string names;
  for (const FaultName& each : kNames)
    names += (names.empty() ? "" : ", ") + std::string(each.name);
  return names;
}

Result<RobotFault> ParseRobotFault(const std::string& text) {
  if (const auto fault = Parse(text)) return *fault;
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

std::vector<std::string> RobotFaults::Advance(Time now) {
  std::vector<std::string> begun;
  if (!drove_at_) return begun;
  for (Entry& entry : entries_) {
    const double into_s = Seconds(now - *drove_at_) - entry.fault.after_s;
    entry.active = into_s >= 0.0 && into_s < entry.fault.for_s;
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
