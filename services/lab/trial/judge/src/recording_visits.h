#pragma once

#include <functional>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// Lets the pair's visitors follow the route one after the other; each that arrives refreshes it.
// The error is a recording that cannot be read.
[[nodiscard]] Result<void> VisitRoute(const RecordingPair& pair, const RecordingOptions& options,
                                      const std::function<void(double share)>& on_progress,
                                      TaughtRecording& taught);

}  // namespace trailcast::trial
