#pragma once

#include <functional>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// Called with a batch's progress, from one thread at a time.
using RecordingProgress = std::function<void(double share, int ended)>;

// Runs all pairs on `jobs` threads. Each recording is taught once for all its replays. The outcomes
// are in the order of the pairs and do not depend on the number of threads. A pair whose files
// cannot be used has an error that names the file; the others go on.
[[nodiscard]] std::vector<Result<RecordingOutcome>> RunRecordingTrials(
    const std::vector<RecordingPair>& pairs, const RecordingOptions& options, int jobs,
    const RecordingProgress& on_progress);

// Returns the errors of these outcomes, in their order. One that several pairs have is said once,
// with how many they are: a missing recording stops all pairs of it.
[[nodiscard]] std::vector<Error> ErrorsOf(const std::vector<Result<RecordingOutcome>>& outcomes);

}  // namespace trailcast::trial
