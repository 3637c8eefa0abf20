#include "agent/next_path.h"

#include <cmath>
#include <utility>

namespace trailcast::agent {
namespace {

// It may have come so far on until it is found.
constexpr double kFound_m = 1.0;
// Places about the joint that are looked at, one in a picture. To look further takes a second, in
// which nobody would see where the robot drives.
constexpr int kLooks = 5;

}  // namespace

bool NextPath::Learn(Feed item) {
  return path_.Take(std::move(item)) && !(path_.complete() && path_.Refusal());
}

bool NextPath::ready() const { return path_.complete() && looks_ < kLooks; }

bool NextPath::TakesOver(const Observation& observation) {
  ++looks_;
  auto step = path_.session()->Observe(observation);
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
