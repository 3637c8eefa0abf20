#pragma once

#include <optional>
#include <string>
#include <vector>

#include "services/image/image.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// What a robot's camera sees, and what it makes of that.
struct GlanceFrame {
  image::GrayImage picture{};
  std::vector<replay::FeatureView> features{};
  int stored = 0;  // features that the segment has
  std::optional<double>
      turn_rad{};  // asked for, positive to the right; nothing: it does not follow

  // It follows features of its segment, which are drawn.
  [[nodiscard]] bool marked() const { return turn_rad && stored > 0; }
};

// The frame, at most 320 pixels wide, for those who are far away: each feature with a line to where
// it will be at the milestone, in its verdict's colour and shape (a disc inside its funnel lane, a
// triangle to the side that it asks for, a cross rejected, with a line to where it should be); in a
// strip below, of a robot that follows, the turn that is asked for.
[[nodiscard]] image::RgbImage DrawGlance(const GlanceFrame& frame);

// The same in words, of ASCII.
[[nodiscard]] std::string GlanceText(const GlanceFrame& frame);

}  // namespace trailcast::agent
