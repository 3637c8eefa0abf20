#pragma once

#include <vector>

#include "services/lab/trial/judge/recording_trial.h"
#include "services/plot/drawing.h"

namespace trailcast::trial {

// Draws a strip for each replay: its estimate of its place on the taught recording, frame by frame,
// with the truth beneath, on bands coloured by its state. A single replay also gets the turns that
// it asked for.
[[nodiscard]] plot::Drawing DrawRecordings(const std::vector<RecordingOutcome>& outcomes);

}  // namespace trailcast::trial
