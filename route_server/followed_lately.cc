#include "route_server/followed_lately.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace trailcast::server {
namespace {

// A robot that has arrived may say that it stands a little beyond the end.
constexpr double kBeyondEnd_m = 0.5;

double ToTenth(double number) { return std::round(number * 10.0) / 10.0; }

// The last one ends where the route does, and is not beyond it.
std::int64_t NumberAt(double along_m, double length_m) {
  const double last = std::ceil(length_m / FollowedLately::kStretch_m) - 1.0;
  return static_cast<std::int64_t>(
      std::min(std::floor(along_m / FollowedLately::kStretch_m), last));
}

}  // namespace

FollowedLately::Count FollowedLately::Faded(Count count, std::int64_t now_unix_ms) {
  const auto age_ms = static_cast<double>(now_unix_ms - count.at_unix_ms);
  const double left = std::exp2(-std::max(0.0, age_ms) / kHalfAfter_ms);
  return {.passed = count.passed * left, .lost = count.lost * left, .at_unix_ms = now_unix_ms};
}

void FollowedLately::Load(std::span<const store::FollowedStretch> followed) {
  for (const store::FollowedStretch& each : followed) {
    counts_.Touch({each.key, each.number}) = {each.passed, each.lost, each.at_unix_ms, true};
  }
}

void FollowedLately::Hear(const exchange::AgentStatus& status, std::int64_t now_unix_ms) {
  using exchange::PathTrust;
  if (status.role != exchange::AgentRole::kFollower) return;
  if (!status.place || status.path_trust == PathTrust::kUnknown) {
    if (Visit* visit = visits_.Find(status.agent)) visit->on_path = false;
    return;
  }
  const route::RouteKey& key = status.place->key;
  const double along_m = status.place->along_m;
  Visit& visit = visits_.Touch(status.agent);
  if (visit.key != key) visit = {.key = key, .length_m = length_of_(key)};
  const bool is_there = visit.length_m && along_m <= *visit.length_m + kBeyondEnd_m;
  visit.on_path = is_there && (visit.on_path || status.path_trust == PathTrust::kSure);
  if (!visit.on_path) return;

  const bool lost = status.path_trust == PathTrust::kLost;
  const std::int64_t number = NumberAt(along_m, *visit.length_m);
  const bool came = !visit.number || number > *visit.number || along_m < visit.furthest_m - kBack_m;
  if (came) {
    visit.number = number;
    visit.furthest_m = along_m;
    visit.lost = false;
  }
  visit.furthest_m = std::max(visit.furthest_m, along_m);
  if (came || (lost && !visit.lost)) {
    Count& count = counts_.Touch({key, *visit.number});
    count = Faded(count, now_unix_ms);
    if (came) count.passed += 1.0;
    if (lost) count.lost += 1.0;
  }
  visit.lost = visit.lost || lost;
  visit.on_path = !lost;
}

std::vector<FollowedLately::Poor> FollowedLately::Poorly(std::int64_t now_unix_ms) const {
  std::vector<Poor> poor;
  for (const auto& [where, count] : counts_) {
    if (count.lost == 0.0) continue;
    const auto& [key, number] = where;
    const Count now = Faded(count, now_unix_ms);
    const double cost = 1.0 + kLostCosts * now.lost / (now.passed + kTakenForGranted);
    const double from_m = static_cast<double>(number) * kStretch_m;
    Poor each{.key = key,
              .from_m = from_m,
              .to_m = from_m + kStretch_m,
              .passed = ToTenth(now.passed),
              .lost = ToTenth(now.lost),
              .cost = ToTenth(cost)};
    if (each.cost > 1.0) poor.push_back(std::move(each));
  }
  std::sort(poor.begin(), poor.end(), [](const Poor& one, const Poor& other) {
    return std::tie(one.key, one.from_m) < std::tie(other.key, other.from_m);
  });
  return poor;
}

std::vector<store::FollowedStretch> FollowedLately::Unsaved() const {
  std::vector<store::FollowedStretch> unsaved;
  for (const auto& [where, count] : counts_) {
    if (count.saved) continue;
    unsaved.push_back({where.first, where.second, count.passed, count.lost, count.at_unix_ms});
  }
  return unsaved;
}

void FollowedLately::NoteSaved() {
  for (auto& [where, count] : counts_) count.saved = true;
}

}  // namespace trailcast::server
