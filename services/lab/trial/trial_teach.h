#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "agent/session/replay_session.h"
#include "services/base/result.h"
#include "services/lab/trial/path_judge.h"
#include "services/lab/trial/route_recorder.h"
#include "services/lab/trial/trial_setup.h"

namespace trailcast::trial {

// What a scout left behind, and where it truly drove.
struct Taught {
  std::vector<TaughtRoute> routes;  // one for each way of teaching
  TruePath path;
  double duration_s = 0.0;
};

// Drives a scout drawn from `seed` along the setup's path once, its frames taught in each
// of these ways. `on_progress` gets the share of the path driven; false ends the drive.
// kUnavailable when the robot cannot get along the path.
[[nodiscard]] Result<Taught> TeachOnce(const TrialSetup& setup, const sim::CameraModel& camera,
                                       const std::vector<agent::TeachOptions>& teachings,
                                       std::uint64_t seed,
                                       const std::function<bool(double share)>& on_progress);

// What a follower gets: the bytes that the scout made, opened again.
// `backwards`: to be driven from the end of what was taught to its beginning.
[[nodiscard]] Result<agent::ReplaySession> OpenSession(const TaughtRoute& taught,
                                                       const agent::ReplayMethodOptions& options,
                                                       bool backwards = false);

}  // namespace trailcast::trial
