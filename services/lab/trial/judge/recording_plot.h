#pragma once

#include <vector>

#include "services/lab/trial/judge/recording_trial.h"
#include "services/plot/drawing.h"

namespace trailcast::trial {

// For each replay a strip: where on the taught recording it took itself to be, frame by frame, with
// the truth beneath, on bands coloured by its state; of one alone also the turns that it asked for.
[[nodiscard]] plot::Drawing DrawRecordings(const std::vector<RecordingOutcome>& outcomes);

}  // namespace trailcast::trial
