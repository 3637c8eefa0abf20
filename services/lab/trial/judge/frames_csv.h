#pragma once

#include <filesystem>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// One file a replay in `folder`, which is made: `shown,frame,cut,state,teach_frame,turn_rad,
// true_teach_frame,true_du_px`, a row a frame; what is not known is empty.
[[nodiscard]] Result<void> WriteFramesCsv(const std::vector<RecordingOutcome>& outcomes,
                                          const std::filesystem::path& folder);

}  // namespace trailcast::trial
