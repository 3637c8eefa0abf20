#pragma once

#include <optional>

#include "services/motion/motion.h"

namespace trailcast::odometry {

// How the picture moved from one frame to the next, by the features that are in both.
struct PictureStep {
  // Counter-clockwise positive, by the focal length that is known or taken: another one makes all
  // turns of a drive larger or smaller by one factor.
  double turn_rad = 0.0;
  double down_share = 0.0;  // of all that is seen, of the picture's width
  double growth = 0.0;      // the same, about the image centre
  double flow = 0.0;        // how far most features moved, either way, of the picture's width
};

// What is told of a drive from one frame to the next.
struct DriveStep {
  double t_s = 0.0;                    // when the later one was taken; these rise
  double dt_s = 0.0;                   // since the one before, above 0
  std::optional<PictureStep> picture;  // nothing: too little is in both
  motion::OdometryIncrement moved;     // by odometry
  bool odometry_broke = false;         // it jumped or was silent: what was driven is not known
  // What the base was told meanwhile; nothing: nobody was heard to tell it anything.
  std::optional<motion::VelocityCommand> told;
};

}  // namespace trailcast::odometry
