#include "agent/follow/next_path.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

// The robot must find itself within this distance of where it comes onto the route.
constexpr double kFound_m = 1.0;
// The number of places about the junction that are tried, one in each picture. Looking further
// takes a second, in which nobody would watch where the robot drives.
constexpr int kLooks = 5;
// The longest duration of the first look, on a machine that is not much too slow for it.
constexpr std::chrono::duration<double> kFirstLook(0.5);
constexpr std::chrono::duration<double> kFrame(0.1);  // until the next one, at least

}  // namespace

NextPath::NextPath(RobotDevice& device, RouteWish wish, KnownPath path)
    : device_(device), wish_(std::move(wish)), path_(std::move(path)), look_(kFirstLook) {}

bool NextPath::Learn(Feed item) {
  return path_.Take(std::move(item)) && !(path_.complete() && path_.Refusal());
}

bool NextPath::ready() const { return path_.complete() && looks_ < kLooks; }

motion::VelocityCommand NextPath::WhileItLooks(motion::VelocityCommand command,
                                               double left_m) const {
  const double most_mps = left_m / std::max(look_, kFrame).count();
  if (std::abs(command.linear_mps) <= most_mps) return command;
  const double share = most_mps / std::abs(command.linear_mps);
  return {share * command.linear_mps, share * command.angular_radps};
}

bool NextPath::TakesOver(const Observation& observation) {
  ++looks_;
  const auto began = std::chrono::steady_clock::now();
  auto step = path_.session()->Observe(observation);
  look_ = std::chrono::steady_clock::now() - began;
  if (!step || step->state != ReplayState::kFollowing || step->trust != Trust::kSure) return false;
  if (!step->along_m || std::abs(path_.OfRoute(*step->along_m) - wish_.begin_m) > kFound_m)
    return false;
  driving_by_ = path_.Comfortable(*std::move(step));
  if (!device_.Drive(driving_by_.command)) return false;
  standstill_.emplace(device_);
  return true;
}

NextPath::Begun NextPath::Take() {
  standstill_->Leave();
  return {std::move(path_), std::move(driving_by_)};
}

}  // namespace trailcast::agent
