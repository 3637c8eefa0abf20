#pragma once

#include <functional>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// How far a batch is: called from one thread at a time.
using RecordingProgress = std::function<void(double share, int ended)>;

// All pairs on `jobs` threads; each recording is taught once, whoever is replayed on it. The
// outcomes come in the order of the pairs, one a pair, and are the same whatever the number of
// threads. A pair whose files cannot be used has an error, which names it; the others go on.
[[nodiscard]] std::vector<Result<RecordingOutcome>> RunRecordingTrials(
    const std::vector<RecordingPair>& pairs, const RecordingOptions& options, int jobs,
    const RecordingProgress& on_progress);

}  // namespace trailcast::trial
