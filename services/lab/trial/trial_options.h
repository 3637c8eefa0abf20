#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "services/lab/sim/places/place.h"

namespace trailcast::trial {

// The options of `trailcast trial`: either a built-in scenario, or one's own world and path.
struct TrialOptions {
  std::string scenario = "indoor";
  sim::PlaceOptions place;  // replaces the scenario if its world is not empty

  std::vector<std::string> methods = {"default"};
  std::string scout_camera = "webcam";     // a built-in name, or a camera file (.toml)
  std::string follower_camera = "webcam";  // likewise; some scenarios have cameras of their own
  // How the two robots' cameras are mounted, as the robots are told.
  double scout_roll_deg = 0.0;
  double follower_roll_deg = 0.0;
  std::optional<double> follower_ahead_m;
  // How far beside the path a follower with a scanner may pass an obstacle; without it, the
  // scenario decides.
  std::optional<double> pass_obstacles_m;
  // The robots with odometry: "both", "scout", "follower" or "none".
  std::string odometry = "both";
  std::string odometry_noise;      // of the follower's; see ParseOdometryNoise
  std::vector<std::string> flaws;  // of the follower, in trials of their own; if empty, the
                                   // scenario's
  double speed_mps = 0.0;          // of the scout on the straight; 0 for the scenario's own
  int trials = 10;                 // for each method and each of the scenario's cases
  std::uint64_t seed = 1;          // seed + i - 1 decides everything in trial i
  // The scout itself follows, with the same camera on the same mount and the same wheels, past
  // nobody, under the sun of its teaching, as the paper measured.
  bool same_robot = false;
  int laps = 1;  // along a path that ends where it begins
  // Each taught route is followed from so many drawn places along it, by robots that are told no
  // place, until they have come a few metres. With 0 it is followed from its beginning to its end.
  int starts = 0;
  bool backwards = false;  // in reverse gear, from the taught path's end to its beginning
  bool matrix = false;     // so many trials of each of its cells (matrix.h)
  // Each taught route is followed so many times, one follower after the other, while the scenario's
  // change grows from visit to visit. With 0 it is followed once, in the changed place.
  int visits = 0;
  std::string spoiled;   // fault of all visitors; one more without it comes last
  bool refresh = false;  // and each follower gets the route as the one before has left it
  // The robots set down along the path are told their places, with an error of this much (one
  // sigma), as if they were sent along a part of a route. Without it they are told none.
  std::optional<double> told_m;
  std::string log_folder;  // gets one log a trial; may be empty
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

}  // namespace trailcast::trial
