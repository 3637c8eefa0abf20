#pragma once

namespace trailcast::agent {

// This is the evidence that carries a robot along its route in one frame.
enum class Evidence {
  kNothing,   // the robot stands
  kFeatures,  // the segment's features, tracked
  kViews,     // key views that are recognised
  kMotion,    // neither: by its motion, as measured or as commanded
};

}  // namespace trailcast::agent
