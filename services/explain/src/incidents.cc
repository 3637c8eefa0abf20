#include "services/explain/src/incidents.h"

#include <fmt/format.h>

#include <algorithm>

#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::RunLog;

constexpr double kFewFound = 0.4;
// A segment may be a little longer by the follower's odometry than by the scout's.
constexpr double kOverrunShare = 0.15;
constexpr double kOverrun_m = 0.2;
// Incidents of one kind that are no further apart are one.
constexpr double kClose_m = 1.0;
constexpr double kClose_frames = 45.0;

void AddHandOver(const Stay& stay, std::vector<Incident>& incidents) {
  if (stay.begun == nullptr) return;
  const double found = stay.begun->fields.Number("found").value_or(0.0);
  const double stored = stay.begun->fields.Number("stored").value_or(0.0);
  const double share = Share(found, stored);
  const bool wide = stay.begun->fields.Find("search") == "wide";
  if (stay.begun->what == "recovered") return;  // the frames' incidents have it
  if (stored > 0.0 && share < kFewFound) {
    incidents.push_back({"few", stay.first, stay.first, 25.0 + 10.0 * (kFewFound - share),
                         fmt::format("hand-over found only {:.0f} of {:.0f} features{}", found,
                                     stored, wide ? ", by the wide search" : "")});
  } else if (wide) {
    incidents.push_back({"wide", stay.first, stay.first, 8.0,
                         fmt::format("hand-over needed the wide search: {:.0f} of {:.0f} features "
                                     "found, not where they were expected",
                                     found, stored)});
  }
}

void AddOverrun(const RunLog& log, const Stay& stay, std::vector<Incident>& incidents) {
  if (stay.begun == nullptr || !HasOdometry(log)) return;
  const auto length_m = stay.begun->fields.Number("length_m");
  const double driven_m = PlaceOf(log.frames[stay.end - 1]) - PlaceOf(log.frames[stay.first]);
  if (!length_m || driven_m <= (1.0 + kOverrunShare) * *length_m + kOverrun_m) return;
  incidents.push_back({"overrun", stay.end - 1, stay.end - 1, 30.0,
                       fmt::format("missed the milestone: {:.2f} m driven in a segment of {:.2f} m",
                                   driven_m, *length_m)});
}

bool Close(const RunLog& log, const Incident& before, const Incident& after) {
  const double apart = PlaceOf(log.frames[after.first]) - PlaceOf(log.frames[before.last]);
  const double frames = log.frames[after.first].frame - log.frames[before.last].frame;
  return HasOdometry(log) ? apart <= kClose_m : frames <= kClose_frames;
}

std::vector<Incident> Merge(const RunLog& log, const std::vector<Incident>& incidents) {
  std::vector<Incident> merged;
  for (const Incident& incident : incidents) {
    const auto before = std::find_if(merged.rbegin(), merged.rend(), [&](const Incident& each) {
      return each.kind == incident.kind;
    });
    if (before == merged.rend() || !Close(log, *before, incident)) {
      merged.push_back(incident);
      continue;
    }
    if (incident.weight > before->weight) before->text = incident.text;
    before->weight = std::max(before->weight, incident.weight);
    before->last = std::max(before->last, incident.last);
    before->times += incident.times;
  }
  return merged;
}

}  // namespace

std::vector<Incident> SegmentIncidents(const RunLog& log) {
  std::vector<Incident> incidents;
  const auto stays = StaysOf(log);
  for (const Stay& stay : stays) {
    AddHandOver(stay, incidents);
    // The last segment's end is the run's.
    if (&stay != &stays.back()) AddOverrun(log, stay, incidents);
  }
  return incidents;
}

std::vector<Incident> FindIncidents(const RunLog& log) {
  std::vector<Incident> all;
  for (auto* find : {PhaseIncidents, SegmentIncidents, FrameIncidents}) {
    const auto found = find(log);
    all.insert(all.end(), found.begin(), found.end());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Incident& a, const Incident& b) { return a.first < b.first; });
  return Merge(log, all);
}

}  // namespace trailcast::explain
