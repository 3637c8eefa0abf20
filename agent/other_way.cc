#include "agent/other_way.h"

namespace trailcast::agent {
namespace {

using mission::Task;

bool AreOfOneRoute(const Task& a, const Task& b) {
  return a.kind == Task::Kind::kFollow && b.kind == Task::Kind::kFollow &&
         a.route.route == b.route.route && a.route.revision == b.route.revision;
}

}  // namespace

OtherWay FindOnWay(std::span<const Task> way, const Task& driven, std::optional<double> along_m) {
  if (!along_m || way.empty()) return {};
  for (std::uint32_t i = 0; i < way.size(); ++i) {
    const Task& task = way[i];
    if (task.kind != Task::Kind::kFollow) break;  // it may not go on beyond that
    const bool is_on = AreOfOneRoute(task, driven) && *along_m >= task.from_m - kOnWay_m &&
                       *along_m <= task.to_m + kPassed_m;
    if (!is_on) continue;
    const bool same_pace = task.speed_factor == driven.speed_factor;
    return {.kind = same_pace ? OtherWay::Kind::kGoesOn : OtherWay::Kind::kBegins, .task = i};
  }
  const bool passed = AreOfOneRoute(way.front(), driven) && *along_m > way.front().to_m;
  return {.kind = passed ? OtherWay::Kind::kMissed : OtherWay::Kind::kBegins};
}

}  // namespace trailcast::agent
