#pragma once

#include <optional>

#include "services/motion/motion.h"

namespace trailcast::odometry {

// How the picture moved from one frame to the next, by the features that both have.
struct PictureStep {
  // Counter-clockwise positive. It is scaled by the focal length that is known or assumed; an error
  // in that scales all turns of a drive by one factor.
  double turn_rad = 0.0;
  double down_share = 0.0;  // the mean over all features, as a share of the picture's width
  double growth = 0.0;      // the same, about the image centre
  double flow = 0.0;        // how far most features moved in either direction, as a share of the
                            // picture's width
};

// The record of a drive between two frames.
struct DriveStep {
  double t_s = 0.0;                    // when the later frame was taken; these times rise
  double dt_s = 0.0;                   // since the frame before, above 0
  std::optional<PictureStep> picture;  // nothing if the frames share too few features
  motion::OdometryIncrement moved;     // by odometry
  bool odometry_broke = false;         // it jumped or was silent, so the motion is not known
  // The command that the base had meanwhile; nothing if none was heard.
  std::optional<motion::VelocityCommand> told;
};

}  // namespace trailcast::odometry
