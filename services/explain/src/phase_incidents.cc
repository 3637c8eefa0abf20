#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "services/explain/src/incidents.h"
#include "services/explain/src/run_index.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunEvent;
using agent::RunLog;

double WeightOf(Phase phase) {
  switch (phase) {
    case Phase::kLost:
      return 100.0;
    case Phase::kCovered:
    case Phase::kLooking:
      return 60.0;
    case Phase::kBlind:
      return 50.0;
    case Phase::kSeeking:
    case Phase::kWaiting:
      return 40.0;
    case Phase::kDistant:
      return 30.0;
    case Phase::kUnsure:
      return 20.0;
    case Phase::kSure:
    case Phase::kArrived:
      break;
  }
  return 0.0;
}

// A log with lookups for its spells, of which it may have as many as rows.
struct Told {
  const RunLog& log;
  std::vector<Stay> stays;
  std::map<int, const std::string*> reasons{};  // by frame, the session's reason as a phase began

  explicit Told(const RunLog& of) : log(of), stays(StaysOf(of)) {
    for (const RunEvent& event : of.events) {
      if (event.what == "phase") reasons.emplace(event.frame, &event.text);
    }
  }
};

std::string ReasonAt(const Told& told, std::size_t row) {
  const auto at = told.reasons.find(told.log.frames[row].frame);
  return at == told.reasons.end() ? "" : *at->second;
}

// Tells what became of a segment's features from its beginning to a row: "12 of 34 were found at
// its start, 4 left the picture, ...".
std::string FateOfFeatures(const Told& told, std::size_t row) {
  const RunLog& log = told.log;
  const auto stay =
      std::upper_bound(told.stays.begin(), told.stays.end(), row,
                       [](std::size_t sought, const Stay& each) { return sought < each.end; });
  if (stay == told.stays.end() || row < stay->first) return "";
  int left = 0;
  int lost = 0;
  for (std::size_t i = stay->first; i <= row; ++i) {
    left += log.frames[i].left_picture;
    lost += log.frames[i].not_returned;
  }
  std::vector<std::string> fates;
  if (stay->begun != nullptr) {
    fates.push_back(fmt::format("{} of {} were found at its start",
                                stay->begun->fields.Find("found").value_or("?"),
                                stay->begun->fields.Find("stored").value_or("?")));
  }
  if (left > 0) fates.push_back(fmt::format("{} left the picture", left));
  if (lost > 0) fates.push_back(fmt::format("{} were lost in tracking", lost));
  const FrameRow& now = log.frames[row];
  if (now.rejected > 0) {
    fates.push_back(fmt::format("{} disagree by {:.0f} px", now.rejected, now.rejected_by_px));
  }
  return fmt::format("{}", fmt::join(fates, ", "));
}

std::string SpeedText(const RunLog& log, const Spell& spell) {
  double fastest_mps = 0.0;
  for (std::size_t i = spell.first; i < spell.end; ++i) {
    fastest_mps = std::max(fastest_mps, std::abs(log.frames[i].linear_mps));
  }
  return fastest_mps > 0.0 ? fmt::format("at up to {:.2f} m/s", fastest_mps) : "standing";
}

const char* Meaning(Phase phase, bool has_odometry) {
  switch (phase) {
    case Phase::kSeeking:
      return "looking for the route's start";
    case Phase::kLooking:
      return "turned on the spot to look for the path";
    case Phase::kDistant:
      return "only distant features, slowly on";
    case Phase::kBlind:
      return has_odometry ? "blind, on by odometry" : "blind, on by the commanded speed";
    case Phase::kCovered:
      return "something covered the view";
    default:
      return ToString(phase);
  }
}

// Describes a spell in which the robot was not sure, but not lost either: its length and the fewest
// features that it saw.
std::string TellSpell(const Told& told, const Spell& spell, double driven_m) {
  const RunLog& log = told.log;
  const bool has_odometry = log.frames[spell.first].driven_m.has_value();
  const bool by_distance = has_odometry && spell.phase != Phase::kLooking;
  std::string text = Meaning(spell.phase, has_odometry);
  text += by_distance ? fmt::format(" for {:.2f} m ({} frames, {})", driven_m,
                                    spell.end - spell.first, SpeedText(log, spell))
                      : fmt::format(" for {} frames", spell.end - spell.first);
  if (spell.phase == Phase::kWaiting)
    return fmt::format("{}: {}", text, ReasonAt(told, spell.first));
  if (spell.phase == Phase::kDistant) {
    double worst_m = 0.0;
    for (std::size_t i = spell.first; i < spell.end; ++i) {
      worst_m = std::max(worst_m, log.frames[i].left_sigma_m.value_or(0.0));
    }
    return fmt::format("{}: the place beside the path was known to {:.2f} m", text, worst_m);
  }
  const auto least = std::min_element(
      log.frames.begin() + static_cast<std::ptrdiff_t>(spell.first),
      log.frames.begin() + static_cast<std::ptrdiff_t>(spell.end),
      [](const FrameRow& a, const FrameRow& b) { return a.agreeing < b.agreeing; });
  // While the start is sought, features are key views' and not a segment's.
  const std::string of_stored =
      least->stored > 0 ? fmt::format("of the segment's {} features", least->stored) : "features";
  return fmt::format("{}, down to {} {}: {}", text, least->agreeing, of_stored,
                     FateOfFeatures(told, spell.first));
}

Incident OfSpell(const Told& told, const Spell& spell) {
  const RunLog& log = told.log;
  const double frames = static_cast<double>(spell.end - spell.first);
  const std::string kind = ToString(spell.phase);
  if (spell.phase == Phase::kLost) {
    return {kind, spell.first, spell.end - 1, WeightOf(spell.phase),
            fmt::format("lost: {}", ReasonAt(told, spell.first))};
  }
  const double driven_m =
      HasOdometry(log) ? PlaceOf(log.frames[spell.end - 1]) - PlaceOf(log.frames[spell.first])
                       : 0.0;
  const double weight = WeightOf(spell.phase) + std::min(15.0, 10.0 * driven_m + 0.05 * frames);
  return {kind, spell.first, spell.end - 1, weight, TellSpell(told, spell, driven_m)};
}

}  // namespace

std::vector<Incident> PhaseIncidents(const RunLog& log) {
  const Told told(log);
  std::vector<Incident> incidents;
  for (const Spell& spell : SpellsOf(log)) {
    if (WeightOf(spell.phase) > 0.0) incidents.push_back(OfSpell(told, spell));
  }
  return incidents;
}

}  // namespace trailcast::explain
