#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "services/lab/sim/places/place.h"

namespace trailcast::trial {

// What `trailcast trial` is told. Either a built-in scenario, or a world and a path of one's own.
struct TrialOptions {
  std::string scenario = "indoor";
  sim::PlaceOptions place;  // its world not empty: in place of the scenario

  std::vector<std::string> methods = {"default"};
  std::string scout_camera = "webcam";     // a built-in name, or a camera file (.toml)
  std::string follower_camera = "webcam";  // the same; some scenarios have cameras of their own
  // What the two robots are told of how their cameras are mounted.
  double scout_roll_deg = 0.0;
  double follower_roll_deg = 0.0;
  std::optional<double> follower_ahead_m;
  // How far beside the path a follower with a scanner may pass what stands on it; nothing: as the
  // scenario says.
  std::optional<double> pass_obstacles_m;
  // Who has odometry: "both", "scout", "follower" or "none".
  std::string odometry = "both";
  std::string odometry_noise;      // of the follower's, as ParseOdometryNoise takes it
  std::vector<std::string> flaws;  // of the follower, each for itself; empty: the scenario's
  double speed_mps = 0.0;          // of the scout on the straight; 0: the scenario's own
  int trials = 10;                 // of each method and each of the scenario's cases
  std::uint64_t seed = 1;          // trial i of n is drawn from seed + i - 1 alone
  // The robot that taught follows, with the same camera on the same mount and the same wheels, past
  // nobody, under the sun of its teaching: how the paper measured.
  bool same_robot = false;
  int laps = 1;  // of a path that ends where it begins
  // Each taught route is followed from so many drawn places along it, by robots that are told no
  // place, until they have come a few metres; 0: from its beginning to its end.
  int starts = 0;
  bool backwards = false;  // in reverse gear, from the taught path's end to its beginning
  // Each taught route is followed so many times, one follower after the other, while the
  // scenario's change grows from visit to visit; 0: once, in the place as it is by then.
  int visits = 0;
  std::string spoiled;   // what is wrong with all visitors; one more comes, with whom nothing is
  bool refresh = false;  // and each follower gets the route as the one before has left it
  // Those robots are told their places, off by so much (one sigma), as by who sends them along a
  // part of a route; nothing: they are told none.
  std::optional<double> told_m;
  std::string log_folder;  // one log a trial goes here; empty: none
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

}  // namespace trailcast::trial
