#include "route_server/network/followed_lately.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace trailcast::server {
namespace {

double ToTenth(double number) { return std::round(number * 10.0) / 10.0; }

}  // namespace

FollowedLately::Count FollowedLately::Faded(Count count, std::int64_t now_unix_ms) {
  const auto age_ms = static_cast<double>(now_unix_ms - count.at_unix_ms);
  const double left = std::exp2(-std::max(0.0, age_ms) / kHalfAfter_ms);
  return {.passed = count.passed * left, .lost = count.lost * left, .at_unix_ms = now_unix_ms};
}

void FollowedLately::Load(std::span<const store::FollowedSection> followed) {
  for (const store::FollowedSection& each : followed) {
    counts_.Touch({each.key, each.number}) = {each.passed, each.lost, each.at_unix_ms, true};
  }
}

void FollowedLately::Hear(const exchange::FollowedSections& told, std::int64_t now_unix_ms) {
  const auto length_m = length_of_(told.key);
  if (!length_m) return;
  for (const exchange::FollowedSections::Section& each : told.sections) {
    if (each.number * exchange::kFollowedSection_m >= *length_m) continue;
    Count& count = counts_.Touch({told.key, each.number});
    count = Faded(count, now_unix_ms);
    count.passed += each.passed;
    count.lost += each.lost;
  }
}

std::vector<FollowedLately::Poor> FollowedLately::Poorly(std::int64_t now_unix_ms) const {
  std::vector<Poor> poor;
  for (const auto& [where, count] : counts_) {
    if (count.lost == 0.0) continue;
    const auto& [key, number] = where;
    const Count now = Faded(count, now_unix_ms);
    const double cost = 1.0 + kLostCosts * now.lost / (now.passed + kTakenForGranted);
    const double from_m = static_cast<double>(number) * exchange::kFollowedSection_m;
    Poor each{.key = key,
              .from_m = from_m,
              .to_m = from_m + exchange::kFollowedSection_m,
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

std::vector<store::FollowedSection> FollowedLately::Unsaved() const {
  std::vector<store::FollowedSection> unsaved;
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
