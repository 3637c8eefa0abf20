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

// The result of a scout's drive, and its true path.
struct Taught {
  std::vector<TaughtRoute> routes;  // one for each way of teaching
  TruePath path;
  double duration_s = 0.0;
};

// Drives a scout drawn from `seed` along the setup's path once, and teaches its frames in each of
// these ways. `on_progress` gets the share of the path that is driven; false ends the drive.
// kUnavailable means that the robot cannot get along the path.
[[nodiscard]] Result<Taught> TeachOnce(const TrialSetup& setup, const sim::CameraModel& camera,
                                       const std::vector<agent::TeachOptions>& teachings,
                                       std::uint64_t seed,
                                       const std::function<bool(double share)>& on_progress);

// Opens a session with the bytes that the scout made. With `backwards`, the route is driven from
// its end to its beginning.
[[nodiscard]] Result<agent::ReplaySession> OpenSession(const TaughtRoute& taught,
                                                       const agent::ReplayMethodOptions& options,
                                                       bool backwards = false);

}  // namespace trailcast::trial
