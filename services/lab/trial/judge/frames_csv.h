#pragma once

#include <filesystem>
#include <vector>

#include "services/lab/trial/judge/recording_trial.h"

namespace trailcast::trial {

// Writes one file a replay into `folder`, which is made, with a row for each frame:
// `shown,frame,cut,state,teach_frame,turn_rad,true_teach_frame,true_du_px`. Unknown values are
// empty.
[[nodiscard]] Result<void> WriteFramesCsv(const std::vector<RecordingOutcome>& outcomes,
                                          const std::filesystem::path& folder);

}  // namespace trailcast::trial
