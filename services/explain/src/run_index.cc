#include "services/explain/src/run_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <unordered_map>
#include <vector>

namespace trailcast::explain {

using agent::FrameRow;
using agent::RunEvent;
using agent::RunLog;

std::vector<Stay> StaysOf(const RunLog& log) {
  std::vector<Stay> stays;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    if (log.frames[i].phase == agent::Phase::kWaiting) continue;
    const int segment = log.frames[i].segment;
    if (stays.empty() || stays.back().segment != segment) stays.push_back({segment, i, i, nullptr});
    stays.back().end = i + 1;
  }
  // A log may have as many events as stays, so they are sorted by segment first.
  std::unordered_map<double, std::vector<Stay*>> by_segment;
  for (Stay& stay : stays) by_segment[stay.segment].push_back(&stay);
  for (const RunEvent& event : log.events) {
    if (event.what != "hand-over" && event.what != "recovered") continue;
    const auto segment = event.fields.Number("segment");
    const auto its = segment ? by_segment.find(*segment) : by_segment.end();
    if (its == by_segment.end()) continue;
    const auto stay = std::partition_point(
        its->second.begin(), its->second.end(),
        [&](const Stay* each) { return log.frames[each->end - 1].frame < event.frame; });
    if (stay != its->second.end() && (*stay)->begun == nullptr) (*stay)->begun = &event;
  }
  return stays;
}

std::vector<Spell> SpellsOf(const RunLog& log) {
  std::vector<Spell> spells;
  for (std::size_t i = 0; i < log.frames.size(); ++i) {
    const agent::Phase phase = log.frames[i].phase;
    if (spells.empty() || spells.back().phase != phase) spells.push_back({phase, i, i});
    spells.back().end = i + 1;
  }
  return spells;
}

std::size_t RowOfFrame(const RunLog& log, int frame) {
  const auto row =
      std::lower_bound(log.frames.begin(), log.frames.end(), frame,
                       [](const FrameRow& each, int number) { return each.frame < number; });
  if (row == log.frames.end()) return log.frames.size() - 1;
  return static_cast<std::size_t>(std::distance(log.frames.begin(), row));
}

bool HasOdometry(const RunLog& log) {
  return !log.frames.empty() && log.frames.back().driven_m.has_value();
}

double PlaceOf(const FrameRow& row) {
  return row.driven_m ? *row.driven_m : static_cast<double>(row.frame);
}

std::string PlaceText(const FrameRow& row) {
  const std::string where = row.driven_m ? fmt::format("{:>7.2f} m", *row.driven_m)
                                         : fmt::format("frame {:>5}", row.frame);
  return fmt::format("{} {:>4.0f} %  segment {:<3}", where, 100.0 * row.progress, row.segment);
}

}  // namespace trailcast::explain
