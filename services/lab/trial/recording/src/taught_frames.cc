#include "services/lab/trial/recording/taught_frames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trailcast::trial {

double TaughtFrameAt(const std::vector<FrameSpan>& segments, double progress) {
  const auto count = static_cast<double>(segments.size());
  const double place = std::clamp(progress, 0.0, 1.0) * count;
  // The route's end belongs to the last segment, and does not begin another one.
  const double index = std::min(std::floor(place), count - 1.0);
  const FrameSpan& span = segments[static_cast<std::size_t>(index)];
  return span.first + (place - index) * (span.last - span.first);
}

}  // namespace trailcast::trial
