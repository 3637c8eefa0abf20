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

// What the belief over the whole route says; shares of what is known of it.
struct Believed {
  double place = 0.0;
  double sigma = 0.0;
  double off_route = 0.0;  // probability
};

// Odometry as a witness of how the robot moves, against the others: what it is told, and the pace
// of the scout.
struct OdometryFigures {
  double trust =
      0.0;  // how likely it is to tell how the robot moves, against the likeliest of them
  // Metres of the route for each of its own; nothing on a route that was taught without odometry.
  std::optional<double> scale;
};

// What became of one frame.
struct ReplayStep {
  motion::VelocityCommand command;  // for the robot's base; zero unless following or blind
  ReplayState state = ReplayState::kWaiting;
  Trust trust = Trust::kSeeking;
  SegmentIndex segment;   // the one being followed
  double fraction = 0.0;  // of that segment, 0..1
  double progress = 0.0;  // of the route as far as it was announced, 0..1, by segment count
  // Place on the route, in the scout's metres from its beginning; nothing before the robot has
  // found the route, and on one that was taught without odometry.
  std::optional<double> along_m;
  int features = 0;          // matched and tracked
  double turn_rad = 0.0;     // desired heading change theta_d, positive to the right
  double found_share = 0.0;  // of stored features found, mean over hand-overs so far
  int hand_overs = 0;
  double magnification = 1.0;   // the follower's pixels per scout's
  replay::FollowStep decision;  // what the method saw and asked for
  Sight sight;
  std::optional<Believed> believed;
  Evidence evidence = Evidence::kNothing;
  std::optional<OdometryFigures> odometry;  // of a robot that has it
  std::string reason;                       // kLost, kBlind, kWaiting: one line for people
  // How its pictures are turned since its camera was found to hang otherwise than the scout's, one
  // line for people; empty: they are not.
  std::string turned;
  std::string passing;  // as replay::Passing says it
  // The camera gave nothing to look at: `trust` says nothing of the path.
  bool saw_nothing = false;
  // What of the robot has failed, for which it stands until that is over; empty: nothing.
  std::string robot_trouble;
  // What the robot stands for that is no failure, until it is gone; empty: nothing.
  std::string robot_waits_for;
};

}  // namespace trailcast::agent
