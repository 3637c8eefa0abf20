#pragma once

namespace trailcast::replay {

// What the paper's funnel says of one feature, whichever method follows.
enum class FeatureVerdict {
  kInside,     // the funnel lane: content
  kAsksRight,  // for a turn to the right
  kAsksLeft,
  kRejected,  // too far from where it should be: the method does not believe it
};

}  // namespace trailcast::replay
