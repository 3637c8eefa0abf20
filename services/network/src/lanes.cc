#include "services/network/lanes.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace trailcast::network {
namespace {

// This is the part of a path that is within one zone, in metres from the path's beginning.
struct Passage {
  double begin_m = 0.0;
  double end_m = 0.0;  // includes its room
  std::size_t lane = 0;
};

// This is a part of a path that stays on one route without a gap.
struct Run {
  Section section{};
  double begin_m = 0.0;  // from the path's beginning
};

std::vector<Run> RunsOf(std::span<const Section> way) {
  std::vector<Run> runs;
  double begin_m = 0.0;
  for (const Section& section : way) {
    if (!runs.empty() && GoesOn(runs.back().section, section)) {
      runs.back().section.to_m = section.to_m;
    } else {
      runs.push_back({section, begin_m});
    }
    begin_m += section.length_m();
  }
  return runs;
}

// This is a range in metres from a section's beginning.
struct Through {
  double enters_m = 0.0;
  double leaves_m = 0.0;
};

// Returns nothing if the section ends before the part, or begins more than `beyond_m` behind it.
std::optional<Through> ThroughOf(const Part& part, const Section& section, double beyond_m) {
  if (part.route != section.route) return std::nullopt;
  const auto [enters_m, leaves_m] =
      std::minmax({section.DrivenAt(part.from_m), section.DrivenAt(part.to_m)});
  if (section.length_m() <= enters_m || leaves_m + beyond_m <= 0.0) return std::nullopt;
  return Through{enters_m, leaves_m};
}

// Tells that the second begins where the first ends, and drives back.
bool TurnsBack(const Section& before, const Section& next) {
  return before.route == next.route && before.to_m == next.from_m && next.turn_rad == 0.0 &&
         before.backwards() != next.backwards();
}

// Returns the zones in the order in which the path meets them, without those that it begins in or
// behind.
std::vector<Passage> PassagesOf(std::span<const Section> way, std::span<const Lane> lanes) {
  std::vector<Passage> passages;
  const std::vector<Run> runs = RunsOf(way);
  std::set<std::size_t> begun_in;
  const Run* before = nullptr;
  for (const Run& run : runs) {
    if (before != nullptr && !TurnsBack(before->section, run.section)) begun_in.clear();
    before = &run;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      for (const Part& part : lanes[i].parts) {
        const auto through = ThroughOf(part, run.section, kRoomBeyondLane_m);
        if (!through) continue;
        const bool begins_in =
            run.begin_m <= 0.0 ? through->enters_m + kBarelyInLane_m < 0.0 : begun_in.contains(i);
        if (begins_in) {
          begun_in.insert(i);
          continue;
        }
        double begin_m = std::max(0.0, through->enters_m - kBeforeLane_m);
        // No robot can come in between before the route's first metre; on it one could.
        if (run.begin_m > 0.0 && begin_m < kWaitingRoom_m) begin_m = 0.0;
        passages.push_back(
            {run.begin_m + begin_m, run.begin_m + through->leaves_m + kRoomBeyondLane_m, i});
      }
    }
  }
  std::sort(passages.begin(), passages.end(),
            [](const Passage& a, const Passage& b) { return a.begin_m < b.begin_m; });
  return passages;
}

// Moves the sections from there on to the second.
void Cut(std::vector<Section>& sections, double at_m, std::vector<Section>& rest) {
  std::vector<Section> before;
  for (const Section& section : sections) {
    const double length_m = section.length_m();
    if (at_m <= kSame_m) {
      rest.push_back(section);
    } else if (at_m >= length_m - kSame_m) {
      before.push_back(section);
    } else {
      before.push_back(section);
      before.back().to_m = section.AlongAfter(at_m);
      rest.push_back(section);
      rest.back().from_m = section.AlongAfter(at_m);
      rest.back().turn_rad = 0.0;
    }
    at_m -= length_m;
  }
  sections = std::move(before);
}

}  // namespace

std::vector<Leg> LegsOf(std::span<const Section> way, std::span<const Lane> lanes,
                        const std::set<std::size_t>& open, double ahead_m) {
  std::vector<Leg> legs{{.sections = {way.begin(), way.end()}}};
  double cut_m = 0.0;  // where the last leg begins
  double end_m = -std::numeric_limits<double>::infinity();
  for (const Passage& passage : PassagesOf(way, lanes)) {
    const bool is_first = legs.size() == 1;
    const bool is_open = open.contains(passage.lane) || passage.begin_m < ahead_m;
    if (is_first && is_open) continue;
    if (is_first || passage.begin_m >= end_m + kWaitingRoom_m) {
      Leg next;
      Cut(legs.back().sections, passage.begin_m - cut_m, next.sections);
      cut_m = passage.begin_m;
      legs.push_back(std::move(next));
    }
    legs.back().lanes.insert(passage.lane);
    end_m = std::max(end_m, passage.end_m);
    legs.back().through_m = std::min(end_m - cut_m, LengthOf(legs.back().sections));
  }
  // A later cut shortens each leg but the last.
  for (Leg& leg : legs) leg.through_m = std::min(leg.through_m, LengthOf(leg.sections));
  return legs;
}

std::set<std::size_t> LanesOn(std::span<const Section> way, std::span<const Lane> lanes) {
  std::set<std::size_t> on;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (const Part& part : lanes[i].parts) {
      for (const Run& run : RunsOf(way)) {
        const double beyond_m = run.begin_m > 0.0 ? kRoomBeyondLane_m : kOutOfLane_m;
        if (ThroughOf(part, run.section, beyond_m)) on.insert(i);
      }
    }
  }
  return on;
}

std::set<std::size_t> LanesAt(const Place& place, std::span<const Lane> lanes, bool backwards,
                              double in_m) {
  const double before_m = backwards ? kOutOfLane_m : -in_m;
  const double beyond_m = backwards ? -in_m : kOutOfLane_m;
  std::set<std::size_t> at;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (const Part& part : lanes[i].parts) {
      const bool is_in = part.route == place.route && place.along_m > part.from_m - before_m &&
                         place.along_m < part.to_m + beyond_m;
      if (is_in) at.insert(i);
    }
  }
  return at;
}

}  // namespace trailcast::network
