#pragma once

#include <functional>
#include <vector>

#include "services/lab/trial/trial.h"

namespace trailcast::trial {

// How far a batch is: called from one thread at a time, with the share of all trials done and what
// is known of those that have ended.
using BatchProgress = std::function<void(double share, int ended, int arrived)>;

// Trials 1 to `options.trials` of each of the set-up's cases, on `options.jobs` threads. The
// outcomes come in their order and are the same whatever the number of threads. An error of any
// trial (a world that cannot be driven, a session that refuses its frames) ends the batch.
[[nodiscard]] Result<std::vector<TrialOutcome>> RunTrials(const TrialSetup& setup,
                                                          const TrialOptions& options,
                                                          const BatchProgress& on_progress);

}  // namespace trailcast::trial
