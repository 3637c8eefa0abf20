#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// A share is missing if there was nothing to judge.
struct RecordingShares {
  std::optional<double> following;  // of all frames
  std::optional<double> lost;
  std::optional<double> right;  // of the frames with a good alignment
  std::optional<double> wrong;
  std::optional<double> side;        // of the frames for which the truth has one
  std::optional<double> correction;  // of those, where the route's own turn is known
  std::optional<double> steering;    // of the frames where the driver steered
  std::optional<double> found;       // in time, of the times when it was off
};
[[nodiscard]] RecordingShares SharesOf(const Verdict& verdict);

// Returns one line a replay for people, and why some ended before their recording.
[[nodiscard]] std::string RecordingTable(const std::vector<RecordingRow>& rows);

// Returns Markdown: the goals for recordings, with a column for each set of pairs, and then every
// replay.
[[nodiscard]] std::string RecordingMarkdown(const std::vector<RecordingRow>& rows);

}  // namespace trailcast::trial
