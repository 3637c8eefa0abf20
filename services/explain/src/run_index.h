#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// One stay in a segment: rows [first, end) of the log. The log's lines may be damaged, so there may
// be no word of how it began.
struct Stay {
  int segment = 0;
  std::size_t first = 0;
  std::size_t end = 0;
  const agent::RunEvent* begun = nullptr;  // its hand-over or recovery; null: not in the log
};
// Point into `log`.
[[nodiscard]] std::vector<Stay> StaysOf(const agent::RunLog& log);

// A run of rows in one phase.
struct Spell {
  agent::Phase phase = agent::Phase::kWaiting;
  std::size_t first = 0;
  std::size_t end = 0;
};
[[nodiscard]] std::vector<Spell> SpellsOf(const agent::RunLog& log);

// The row of that frame, or the next one that is there; the last for frames beyond. Not for logs
// without rows.
[[nodiscard]] std::size_t RowOfFrame(const agent::RunLog& log, int frame);

// Whether places are told in metres driven, or in frames: robots without odometry.
[[nodiscard]] bool HasOdometry(const agent::RunLog& log);
// How far along the run: metres driven, or the frame's number.
[[nodiscard]] double PlaceOf(const agent::FrameRow& row);
// "  3.21 m   22 %  segment 4 "
[[nodiscard]] std::string PlaceText(const agent::FrameRow& row);

[[nodiscard]] inline double Share(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace trailcast::explain
