#include "agent/follow/keep_distance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "services/base/square.h"
#include "services/base/time.h"

namespace trailcast::agent {
namespace {

// Places in one cell of this length count as the same: robots know each other's places no better
// over a radio. With cells, unlike distances, there is always a first among three robots.
constexpr double kCell_m = 0.25;
// A robot is assumed to have gone on with its reported speed, but for no longer than this.
constexpr double kLongestGuess_s = 1.0;
constexpr double kSilent_s = 2.0;  // worth mentioning

double CellOf(double along_m) { return std::floor(along_m / kCell_m); }

}  // namespace

std::string WaitText(const Spacing& spacing, std::chrono::steady_clock::time_point now) {
  const Neighbour& other = *spacing.waits_for;
  std::string text =
      fmt::format("waits for {}, {:.1f} m ahead", other.agent.value(), spacing.ahead_m);
  const double silent_s = Seconds(now - other.told_at);
  if (silent_s > kSilent_s) text += fmt::format(" and not heard for {:.0f} s", silent_s);
  return text;
}

bool KeepDistance::IsAhead(const Neighbour& other, double along_m, Time now) const {
  const double since_s = std::clamp(Seconds(now - other.told_at), 0.0, kLongestGuess_s);
  const double theirs = CellOf(other.along_m + std::max(0.0, other.speed_mps) * since_s);
  const double own = CellOf(along_m);
  return theirs != own ? theirs > own : other.agent < self_;
}

// From this speed it stops within the room: v t + v^2 / 2 a = room, solved for v.
double KeepDistance::SpeedWithin(double room_m) const {
  const double a = options_.deceleration_mps2;
  const double at = a * options_.reaction_s;
  return std::sqrt(Square(at) + 2.0 * a * std::max(0.0, room_m)) - at;
}

Spacing KeepDistance::Keep(double along_m, double speed_mps, std::span<const Neighbour> neighbours,
                           Time now) {
  const Neighbour* next = nullptr;
  for (const Neighbour& other : neighbours) {
    if (!IsAhead(other, along_m, now)) continue;
    if (next == nullptr || other.along_m < next->along_m) next = &other;
  }
  const bool stood = std::exchange(standing_, false);
  if (next == nullptr) return {};
  const double ahead_m = next->along_m - along_m;
  const double room_m = ahead_m - options_.distance_m;
  const double may_mps = SpeedWithin(room_m);
  standing_ = may_mps < options_.standing_mps || (stood && room_m < options_.go_on_m);
  if (standing_) return {0.0, *next, std::max(0.0, ahead_m)};
  return {std::min(1.0, may_mps / speed_mps), std::nullopt, ahead_m};
}

}  // namespace trailcast::agent
