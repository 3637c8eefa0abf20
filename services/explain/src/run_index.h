#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"

namespace trailcast::explain {

// One stay in a segment: rows [first, end) of the log. Since the log's lines may be damaged, the
// event with which it began may be missing.
struct Stay {
  int segment = 0;
  std::size_t first = 0;
  std::size_t end = 0;
  const agent::RunEvent* begun = nullptr;  // its hand-over or recovery; null if the log lacks it
};
// The stays point into `log`.
[[nodiscard]] std::vector<Stay> StaysOf(const agent::RunLog& log);

// Consecutive rows in one phase.
struct Spell {
  agent::Phase phase = agent::Phase::kWaiting;
  std::size_t first = 0;
  std::size_t end = 0;
};
[[nodiscard]] std::vector<Spell> SpellsOf(const agent::RunLog& log);

// Returns the row of that frame, or else the next one, or the last for frames beyond the end. The
// log must have rows.
[[nodiscard]] std::size_t RowOfFrame(const agent::RunLog& log, int frame);

// Says whether places are in metres driven; a robot without odometry has them in frames.
[[nodiscard]] bool HasOdometry(const agent::RunLog& log);
// Returns how far along the run a row is: metres driven, or the frame's number.
[[nodiscard]] double PlaceOf(const agent::FrameRow& row);
// Returns "  3.21 m   22 %  segment 4 ".
[[nodiscard]] std::string PlaceText(const agent::FrameRow& row);

[[nodiscard]] inline double Share(double part, double whole) {
  return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace trailcast::explain
