#include "agent/duty/src/rerouting.h"

#include <cmath>

namespace trailcast::agent {
namespace {

using mission::Task;

bool AreOfOneRoute(const Task& a, const Task& b) {
  return a.kind == Task::Kind::kFollow && b.kind == Task::Kind::kFollow &&
         a.route.route == b.route.route && a.route.revision == b.route.revision &&
         a.backwards == b.backwards;
}

double LengthOf(const Task& task) { return std::abs(task.to_m - task.from_m); }

// Returns how much of an order a robot at that place has done, which is negative before its
// beginning.
double DoneAt(const Task& task, double along_m) {
  return task.backwards ? task.from_m - along_m : along_m - task.from_m;
}

}  // namespace

Rerouting FindOnPath(std::span<const Task> way, const Task& driven, std::optional<double> along_m) {
  if (!along_m || way.empty()) return {};
  for (std::uint32_t i = 0; i < way.size(); ++i) {
    const Task& task = way[i];
    if (task.kind != Task::Kind::kFollow) break;  // the robot may not go on beyond that
    const double done_m = DoneAt(task, *along_m);
    const bool is_on =
        AreOfOneRoute(task, driven) && done_m >= -kOnPath_m && done_m <= LengthOf(task) + kPassed_m;
    if (!is_on) continue;
    const bool same_pace = task.speed_factor == driven.speed_factor;
    return {.kind = same_pace ? Rerouting::Kind::kGoesOn : Rerouting::Kind::kBegins, .task = i};
  }
  const bool passed =
      AreOfOneRoute(way.front(), driven) && DoneAt(way.front(), *along_m) > LengthOf(way.front());
  return {.kind = passed ? Rerouting::Kind::kMissed : Rerouting::Kind::kBegins};
}

}  // namespace trailcast::agent
