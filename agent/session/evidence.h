#pragma once

namespace trailcast::agent {

// The evidence that carries a robot along its route in one frame.
enum class Evidence {
  kNothing,   // it stands
  kFeatures,  // the segment's features, tracked
  kViews,     // key views that are recognised
  kMotion,    // neither: how it is measured, or told, to move
};

}  // namespace trailcast::agent
