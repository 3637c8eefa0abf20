#include "services/network/lanes.h"

#include <algorithm>
#include <limits>

namespace trailcast::network {
namespace {

// Of a way, in metres from its beginning, what is of one lane.
struct Passage {
  double begin_m = 0.0;
  double end_m = 0.0;  // with its room
  std::size_t lane = 0;
};

// A part of a way that is of one route without a gap.
struct Run {
  Stretch stretch{};
  double begin_m = 0.0;  // from the way's beginning
};

std::vector<Run> RunsOf(std::span<const Stretch> way) {
  std::vector<Run> runs;
  double begin_m = 0.0;
  for (const Stretch& stretch : way) {
    if (!runs.empty() && GoesOn(runs.back().stretch, stretch)) {
      runs.back().stretch.to_m = stretch.to_m;
    } else {
      runs.push_back({stretch, begin_m});
    }
    begin_m += stretch.to_m - stretch.from_m;
  }
  return runs;
}

// In the order in which the way comes to them; without those that it begins in or behind.
std::vector<Passage> PassagesOf(std::span<const Stretch> way, std::span<const Lane> lanes) {
  std::vector<Passage> passages;
  for (const Run& run : RunsOf(way)) {
    const auto& [route, from_m, to_m, speed] = run.stretch;
    for (std::size_t i = 0; i < lanes.size(); ++i) {
      for (const Part& part : lanes[i].parts) {
        const bool meets =
            part.route == route && to_m > part.from_m && from_m < part.to_m + kRoomBeyondLane_m;
        const bool begins_in = run.begin_m <= 0.0 && from_m > part.from_m + kBarelyInLane_m;
        if (!meets || begins_in) continue;
        double begin_m = std::max(0.0, part.from_m - kBeforeLane_m - from_m);
        // Before the route's first metre nobody can come in between; on it somebody could.
        if (run.begin_m > 0.0 && begin_m < kWaitingRoom_m) begin_m = 0.0;
        passages.push_back(
            {run.begin_m + begin_m, run.begin_m + part.to_m + kRoomBeyondLane_m - from_m, i});
      }
    }
  }
  std::sort(passages.begin(), passages.end(),
            [](const Passage& a, const Passage& b) { return a.begin_m < b.begin_m; });
  return passages;
}

// The stretches from there on go to the second.
void Cut(std::vector<Stretch>& stretches, double at_m, std::vector<Stretch>& rest) {
  std::vector<Stretch> before;
  for (const Stretch& stretch : stretches) {
    const double length_m = stretch.to_m - stretch.from_m;
    if (at_m <= kSame_m) {
      rest.push_back(stretch);
    } else if (at_m >= length_m - kSame_m) {
      before.push_back(stretch);
    } else {
      before.push_back(stretch);
      before.back().to_m = stretch.from_m + at_m;
      rest.push_back(stretch);
      rest.back().from_m = stretch.from_m + at_m;
    }
    at_m -= length_m;
  }
  stretches = std::move(before);
}

}  // namespace

std::vector<Leg> LegsOf(std::span<const Stretch> way, std::span<const Lane> lanes,
                        const std::set<std::size_t>& open, double ahead_m) {
  std::vector<Leg> legs{{.stretches = {way.begin(), way.end()}}};
  double cut_m = 0.0;  // where the last leg begins
  double end_m = -std::numeric_limits<double>::infinity();
  for (const Passage& passage : PassagesOf(way, lanes)) {
    const bool is_first = legs.size() == 1;
    const bool is_open = open.contains(passage.lane) || passage.begin_m < ahead_m;
    if (is_first && is_open) continue;
    if (is_first || passage.begin_m >= end_m + kWaitingRoom_m) {
      Leg next;
      Cut(legs.back().stretches, passage.begin_m - cut_m, next.stretches);
      cut_m = passage.begin_m;
      legs.push_back(std::move(next));
    }
    legs.back().lanes.insert(passage.lane);
    end_m = std::max(end_m, passage.end_m);
    legs.back().through_m = std::min(end_m - cut_m, LengthOf(legs.back().stretches));
  }
  // Of each but the last, what a later cut has left.
  for (Leg& leg : legs) leg.through_m = std::min(leg.through_m, LengthOf(leg.stretches));
  return legs;
}

std::set<std::size_t> LanesOn(std::span<const Stretch> way, std::span<const Lane> lanes) {
  std::set<std::size_t> on;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (const Part& part : lanes[i].parts) {
      for (const Run& run : RunsOf(way)) {
        const double beyond_m = run.begin_m > 0.0 ? kRoomBeyondLane_m : kOutOfLane_m;
        const bool meets = part.route == run.stretch.route && run.stretch.to_m > part.from_m &&
                           run.stretch.from_m < part.to_m + beyond_m;
        if (meets) on.insert(i);
      }
    }
  }
  return on;
}

std::set<std::size_t> LanesAt(const Place& place, std::span<const Lane> lanes, double in_m) {
  std::set<std::size_t> at;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    for (const Part& part : lanes[i].parts) {
      const bool is_in = part.route == place.route && place.along_m > part.from_m + in_m &&
                         place.along_m < part.to_m + kOutOfLane_m;
      if (is_in) at.insert(i);
    }
  }
  return at;
}

}  // namespace trailcast::network
