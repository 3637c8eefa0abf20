#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/image/image.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// A camera's frame, and what the robot makes of it.
struct SnapshotFrame {
  image::GrayImage picture{};
  std::vector<replay::FeatureView> features{};
  int stored = 0;                    // features that the segment has
  std::optional<double> turn_rad{};  // positive to the right; nothing if it does not follow

  // Says whether it follows features of its segment, which are drawn.
  [[nodiscard]] bool marked() const { return turn_rad && stored > 0; }
};

// Draws the frame, at most 320 pixels wide, for viewers at a distance. Each feature has a line to
// where it will be at the milestone, in its verdict's colour and shape: a disc inside its funnel
// lane, a triangle to the side that it asks for, and a cross if it is rejected, with a line to
// where it should be. A strip below shows the turn that a following robot asks for.
[[nodiscard]] image::RgbImage DrawSnapshot(const SnapshotFrame& frame);

// Returns the same in words of ASCII.
[[nodiscard]] std::string SnapshotText(const SnapshotFrame& frame);

}  // namespace trailcast::agent
