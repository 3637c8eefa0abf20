#pragma once

#include <functional>
#include <vector>

#include "services/lab/trial/trial.h"

namespace trailcast::trial {

// Called from one thread at a time, with the share of all trials that is done and the number of
// those that have ended and arrived.
using BatchProgress = std::function<void(double share, int ended, int arrived)>;

// Runs trials 1 to `options.trials` of each of the set-up's cases, on `options.jobs` threads. The
// outcomes are in their order and do not depend on the number of threads. An error in any trial (a
// world that cannot be driven, a session that refuses its frames) ends the batch.
[[nodiscard]] Result<std::vector<TrialOutcome>> RunTrials(const TrialSetup& setup,
                                                          const TrialOptions& options,
                                                          const BatchProgress& on_progress);

}  // namespace trailcast::trial
