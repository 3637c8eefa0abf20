#pragma once

#include <optional>
#include <string>

#include "agent/session/confidence.h"
#include "agent/session/evidence.h"
#include "agent/session/replay_state.h"
#include "agent/session/sight.h"
#include "services/base/ids.h"
#include "services/motion/motion.h"
#include "services/replay/follower.h"

namespace trailcast::agent {

// This is the belief over the whole route, in shares of what is known of it.
struct Believed {
  double place = 0.0;
  double sigma = 0.0;
  double off_route = 0.0;  // probability
};

// This is odometry as a witness of the robot's motion, against the others: its commands, and the
// scout's pace.
struct OdometryFigures {
  double trust = 0.0;  // probability of being right, relative to the likeliest
  // This is metres of the route for each of its own. It is empty on a route that was taught without
  // odometry.
  std::optional<double> scale;
};

// This is the outcome of one frame.
struct ReplayStep {
  motion::VelocityCommand command;  // for the robot's base; zero unless following or blind
  ReplayState state = ReplayState::kWaiting;
  Trust trust = Trust::kSeeking;
  SegmentIndex segment;   // the one that is being followed
  double fraction = 0.0;  // share of that segment, 0..1
  double progress = 0.0;  // share of the route as it was announced, 0..1, by segment count
  // This is the place on the route, in the scout's metres from its beginning. It is empty before
  // the robot has found the route, and on a route that was taught without odometry.
  std::optional<double> along_m;
  int features = 0;          // matched and tracked
  double turn_rad = 0.0;     // desired heading change theta_d, positive to the right
  double found_share = 0.0;  // share of stored features found, mean over hand-overs so far
  int hand_overs = 0;
  double magnification = 1.0;   // the follower's pixels for each of the scout's
  replay::FollowStep decision;  // the method's inputs and its request
  Sight sight;
  std::optional<Believed> believed;
  Evidence evidence = Evidence::kNothing;
  std::optional<OdometryFigures> odometry;  // of a robot that has odometry
  std::string reason;  // why it is kLost, kBlind or kWaiting, in one line for people
  // This tells people in one line how pictures are turned since the camera was found to be mounted
  // otherwise than the scout's. It is empty if they are not.
  std::string turned;
  std::string passing;  // from replay::Passing
  // The camera gave no usable picture, so `trust` says nothing of the path.
  bool saw_nothing = false;
  // This is the failed part of the robot that it stands for until that is over. It is empty if
  // there is none.
  std::string robot_trouble;
  // This is what the robot stands for that is no failure, until it is gone. It is empty if there is
  // none.
  std::string robot_waits_for;
};

}  // namespace trailcast::agent
