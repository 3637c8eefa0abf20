#pragma once

#include <functional>
#include <string>
#include <vector>

#include "agent/device/recorded_device.h"
#include "services/base/result.h"
#include "services/lab/trial/route_recorder.h"

namespace trailcast::trial {

struct TaughtRecording {
  // The route, or why the recording cannot be one.
  Result<TaughtRoute> route;
  std::vector<FrameSpan> spans;  // of its segments
  int frames = 0;
  std::vector<std::string> visits;  // outcomes of the followers that refreshed it, for people
};

// Teaches a route with a recording, as an agent would. `on_progress` gets the share that is done,
// 0..1. The error is a recording that cannot be read.
[[nodiscard]] Result<TaughtRecording> TeachRecording(
    const agent::RecordedRun& run, const agent::TeachOptions& options,
    const std::function<void(double share)>& on_progress);

}  // namespace trailcast::trial
