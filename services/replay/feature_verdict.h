#pragma once

namespace trailcast::replay {

// This is what the paper's funnel says of one feature, whichever method follows.
enum class FeatureVerdict {
  kInside,     // in the funnel lane: it asks for no turn
  kAsksRight,  // it asks for a turn to the right
  kAsksLeft,
  kRejected,  // too far from where it should be, so the method does not trust it
};

}  // namespace trailcast::replay
