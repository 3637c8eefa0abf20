#pragma once

#include <functional>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// How far a batch is: called from one thread at a time.
using RecordingProgress = std::function<void(double share, int ended)>;

// All pairs on `jobs` threads; each recording is taught once, whoever is replayed on it. The
// outcomes come in the order of the pairs and are the same whatever the number of threads. The
// error is the first pair's whose files cannot be used; it ends the batch.
[[nodiscard]] Result<std::vector<RecordingOutcome>> RunRecordingTrials(
    const std::vector<RecordingPair>& pairs, const RecordingOptions& options, int jobs,
    const RecordingProgress& on_progress);

}  // namespace trailcast::trial
