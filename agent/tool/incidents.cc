#include "agent/tool/incidents.h"

#include <fmt/format.h>

#include <algorithm>

#include "agent/tool/run_index.h"

namespace trailcast::tool {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;

constexpr double kFewFound = 0.4;
// A segment may be a little longer by the follower's wheels than by the scout's.
constexpr double kOverrunShare = 0.15;
constexpr double kOverrun_m = 0.2;
// What of one kind lies no further apart is one incident.
constexpr double kClose_m = 1.0;
constexpr double kClose_frames = 45.0;

double WeightOf(Phase phase) {
  switch (phase) {
    case Phase::kLost:
      return 100.0;
    case Phase::kCovered:
      return 60.0;
    case Phase::kBlind:
      return 50.0;
    case Phase::kSeeking:
    case Phase::kWaiting:
      return 40.0;
    case Phase::kUnsure:
      return 20.0;
    case Phase::kSure:
    case Phase::kArrived:
      break;
  }
  return 0.0;
}

// What the session said when the phase began.
std::string ReasonAt(const RunLog& log, std::size_t row) {
  for (const RunEvent& event : log.events) {
    if (event.what == "phase" && event.frame == log.frames[row].frame) return event.text;
  }
  return "";
}

// "12 of 34 found at the hand-over; since then 4 left the picture, ...": what became of a segment's
// features up to a row.
std::string FateOfFeatures(const RunLog& log, std::size_t row) {
  const auto stays = StaysOf(log);
  const auto stay = std::find_if(stays.begin(), stays.end(), [&](const Stay& each) {
    return each.first <= row && row < each.end;
  });
  if (stay == stays.end()) return "";
  int left = 0;
  int lost = 0;
  for (std::size_t i = stay->first; i <= row; ++i) {
    left += log.frames[i].left_picture;
    lost += log.frames[i].not_returned;
  }
  std::string text;
  if (stay->begun != nullptr) {
    text = fmt::format("{} of {} had been found, then ",
                       stay->begun->fields.Find("found").value_or("?"),
                       stay->begun->fields.Find("stored").value_or("?"));
  }
  text += fmt::format("{} left the picture, {} were lost in tracking", left, lost);
  const FrameRow& now = log.frames[row];
  if (now.rejected > 0) {
    text += fmt::format(", {} disagree by {:.0f} px", now.rejected, now.rejected_by_px);
  }
  return text;
}

std::string SpeedText(const RunLog& log, const Spell& spell) {
  double fastest_mps = 0.0;
  for (std::size_t i = spell.first; i < spell.end; ++i) {
    fastest_mps = std::max(fastest_mps, log.frames[i].linear_mps);
  }
  return fastest_mps > 0.0 ? fmt::format("at up to {:.2f} m/s", fastest_mps) : "standing";
}

Incident OfSpell(const RunLog& log, const Spell& spell) {
  const FrameRow& first = log.frames[spell.first];
  const FrameRow& last = log.frames[spell.end - 1];
  const std::size_t frames = spell.end - spell.first;
  std::string text = ToString(spell.phase);
  double driven_m = 0.0;
  if (spell.phase != Phase::kLost) {
    driven_m = first.driven_m && last.driven_m ? *last.driven_m - *first.driven_m : 0.0;
    text += first.driven_m ? fmt::format(" for {:.2f} m ({} frames, {})", driven_m, frames,
                                         SpeedText(log, spell))
                           : fmt::format(" for {} frames", frames);
  }
  const std::string reason = ReasonAt(log, spell.first);
  if (!reason.empty()) text += ": " + reason;
  if (spell.phase != Phase::kWaiting) text += "; " + FateOfFeatures(log, spell.first);
  const double weight =
      WeightOf(spell.phase) + std::min(15.0, 10.0 * driven_m + 0.05 * static_cast<double>(frames));
  return {ToString(spell.phase), spell.first, spell.end - 1, weight, text};
}

void AddHandOver(const Stay& stay, std::vector<Incident>& incidents) {
  if (stay.begun == nullptr) return;
  const double found = stay.begun->fields.Number("found").value_or(0.0);
  const double stored = stay.begun->fields.Number("stored").value_or(0.0);
  const double share = Share(found, stored);
  const bool wide = stay.begun->fields.Find("search") == "wide";
  if (stay.begun->what == "recovered") return;  // told among the frames
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

std::vector<Incident> PhaseIncidents(const RunLog& log) {
  std::vector<Incident> incidents;
  for (const Spell& spell : SpellsOf(log)) {
    if (WeightOf(spell.phase) > 0.0) incidents.push_back(OfSpell(log, spell));
  }
  return incidents;
}

std::vector<Incident> SegmentIncidents(const RunLog& log) {
  std::vector<Incident> incidents;
  const auto stays = StaysOf(log);
  for (const Stay& stay : stays) {
    AddHandOver(stay, incidents);
    // The last one's end is the run's.
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

}  // namespace trailcast::tool
