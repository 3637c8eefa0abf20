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

NextPath::~NextPath() {
  // A base that cannot even be told to stand is the base's own watchdog's matter.
  if (driving_by_) (void)device_.Drive({});
}

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
  ReplayStep comfortable = path_.Comfortable(*std::move(step));
  if (!device_.Drive(comfortable.command)) return false;
  driving_by_ = std::move(comfortable);
  return true;
}

NextPath::Begun NextPath::Take() {
  Begun begun{std::move(path_), *std::move(driving_by_)};
  driving_by_.reset();
  return begun;
}

}  // namespace trailcast::agent
