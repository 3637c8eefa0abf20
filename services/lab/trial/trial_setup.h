#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/session/replay_method.h"
#include "agent/session/teach_session.h"
#include "services/base/result.h"
#include "services/lab/sim/core/camera.h"
#include "services/lab/sim/core/disturbances.h"
#include "services/lab/sim/core/path.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/sim/places/place.h"
#include "services/lab/trial/matrix.h"
#include "services/lab/trial/recording/odometry_noise.h"
#include "services/lab/trial/spoiled_eyes.h"
#include "services/lab/trial/trial_options.h"

namespace trailcast::trial {

// The conditions, except for the seed, in which trials of one scenario differ.
struct TrialCase {
  agent::ReplayMethod method = agent::ReplayMethod::kDefault;
  sim::CameraModel scout_camera;
  sim::CameraModel follower_camera;
  double push_m = 0.0;  // to the left, half way; 0 for none
  bool through_server = false;
  std::string flaw;  // of the follower, one of Flaws(); may be empty
  int start = 0;     // the drawn place where it begins, from 1; 0 for the path's beginning
  std::optional<MatrixCell> cell{};  // of the matrix, if trials are of one
};

// Returns how a scout of that method teaches. For the printed methods, segments end by the 50 %
// rule or at the length on which the paper's figures are based, and keep all of their features,
// without additional ones in the middle.
[[nodiscard]] agent::TeachOptions TeachingFor(agent::ReplayMethod method);

// Everything that the trials of one command share, read and checked.
struct TrialSetup {
  std::string scenario;  // its name, or the world file's without its extension
  std::shared_ptr<const sim::World> world;
  sim::DrivenPath path;
  double speed_mps = 0.0;
  sim::Disturbances follower;
  bool backwards = false;  // from the taught path's end to its beginning
  int laps = 1;            // how many each follower drives, one after the other
  bool sun_moves = false;  // between teaching and following
  bool scout_has_odometry = true;
  bool follower_has_odometry = true;
  OdometryNoise odometry_noise;                 // of the follower's
  bool same_robot = false;                      // each follower is the scout that taught it
  double scout_roll_deg = 0.0;                  // as the robots are told of their cameras
  agent::ReplayMethodOptions follower_options;  // except for the method
  // Returns the others at the place, drawn from the robot's seed; nobody unless the scenario has
  // some.
  std::function<Result<sim::Actors>(sim::Role role, std::uint64_t seed)> actors =
      [](sim::Role, std::uint64_t) { return sim::Actors{}; };
  bool scanner = false;                 // followers have one
  Spoiled spoiled = Spoiled::kNothing;  // with several visits, all visitors have it except one more
                                        // at the end
  // Returns the world after that share of the scenario's change; null if it does not change.
  std::function<Result<std::shared_ptr<const sim::World>>(double share)> world_after{};
  std::vector<TrialCase> cases;  // at least one
};

// Loads the world and looks up the names. Errors list the existing ones.
[[nodiscard]] Result<TrialSetup> PrepareTrials(const TrialOptions& options);

// Returns the built-in ones.
[[nodiscard]] std::vector<std::string> CameraNames();

}  // namespace trailcast::trial
