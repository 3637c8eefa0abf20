#include "agent/session/replay_method.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "services/replay/funnel_follower.h"
#include "services/replay/path_follower.h"

namespace trailcast::agent {
namespace {

struct NamedMethod {
  const char* name;
  ReplayMethod method;
};
constexpr std::array kMethods = {NamedMethod{"default", ReplayMethod::kDefault},
                                 NamedMethod{"paper", ReplayMethod::kPaper},
                                 NamedMethod{"icra2006", ReplayMethod::kIcra2006}};

constexpr double kKnownMagnification = 0.005;  // relative, for an earlier run's magnification
constexpr double kBangBang_radps = 0.35;
// Doubts of the scales of way and turn, as logarithms: where a base does what it is told, and where
// the scout's own metres are known by sight alone.
constexpr double kTold_log = 0.1;
constexpr double kBySight_log = 0.6;
constexpr double kBySight_log_noise = 0.05;
constexpr double kBySightTurn_log = 0.2;
constexpr double kBySightAhead_m = 0.05;

}  // namespace

const char* ToString(ReplayMethod method) {
  const auto* found = std::find_if(kMethods.begin(), kMethods.end(),
                                   [&](const NamedMethod& each) { return each.method == method; });
  return found == kMethods.end() ? "unknown" : found->name;
}

const std::vector<std::string>& ReplayMethodNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    all.reserve(kMethods.size());
    for (const NamedMethod& each : kMethods) all.emplace_back(each.name);
    return all;
  }();
  return names;
}

Result<ReplayMethod> FindReplayMethod(const std::string& name) {
  for (const NamedMethod& each : kMethods) {
    if (name == each.name) return each.method;
  }
  return Fail(ErrorCode::kNotFound, "there is no method '{}'; there are: {}", name,
              fmt::join(ReplayMethodNames(), ", "));
}

std::unique_ptr<replay::Follower> MakeFollower(const ReplayMethodOptions& options, WayBy way,
                                               int scout_width_px, double magnification,
                                               bool known) {
  if (options.method == ReplayMethod::kDefault && way != WayBy::kNothing) {
    replay::PathFollowerOptions path;
    path.limits = options.limits;
    path.speed_factor = options.speed_factor;
    if (known) path.estimator.start_magnification = kKnownMagnification;
    path.estimator.camera_ahead_m = options.camera_ahead_m;
    if (way == WayBy::kCommands) path.estimator.way_log = path.estimator.turn_log = kTold_log;
    if (way == WayBy::kSight) {
      path.estimator.way_log = kBySight_log;
      path.estimator.turn_log = kBySightTurn_log;
      path.estimator.way_log_noise = kBySight_log_noise;
      path.estimator.untold_ahead_m = kBySightAhead_m;
    }
    return std::make_unique<replay::PathFollower>(scout_width_px, magnification, path);
  }
  replay::FunnelFollowerOptions funnel;
  if (options.method == ReplayMethod::kIcra2006) {
    funnel.bang_bang_radps = kBangBang_radps;
    funnel.compensate_roll = false;
  }
  funnel.limits = options.limits;
  funnel.speed_factor = options.speed_factor;
  return std::make_unique<replay::FunnelFollower>(scout_width_px, magnification, funnel);
}

}  // namespace trailcast::agent
