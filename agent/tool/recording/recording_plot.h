#pragma once

#include <vector>

#include "agent/tool/recording/recording_trial.h"
#include "services/image/image.h"

namespace trailcast::tool {

// For each replay a strip: where on the taught recording it took itself to be, frame by frame, with
// the truth beneath, on bands coloured by its state; of one alone also the turns that it asked for.
[[nodiscard]] image::RgbImage DrawRecordings(const std::vector<RecordingOutcome>& outcomes);

}  // namespace trailcast::tool
