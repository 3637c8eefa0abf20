#pragma once

#include <vector>

namespace trailcast::trial {

// The frames of a taught recording from which one segment of its route was made.
struct FrameSpan {
  int first = 0;
  int last = 0;  // the milestone; the next segment begins with it, or after a gap

  bool operator==(const FrameSpan&) const = default;
};

// Returns the frame of the taught recording at `progress` of its route: 0..1 by segment count, as a
// replay reports it. `segments` must not be empty.
[[nodiscard]] double TaughtFrameAt(const std::vector<FrameSpan>& segments, double progress);

}  // namespace trailcast::trial
