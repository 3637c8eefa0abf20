#pragma once

namespace trailcast::agent {

// What carries a robot along its route in one frame.
enum class Evidence {
  kNothing,   // it stands
  kFeatures,  // the segment's features, tracked
  kViews,     // key views that are recognised
  kMotion,    // neither: how it is measured, or told, to move
};

[[nodiscard]] const char* ToString(Evidence evidence);

}  // namespace trailcast::agent
