#pragma once

#include <filesystem>

#include "agent/diagnosis/diagnosis.h"
#include "services/base/result.h"
#include "services/lab/trial/trial_options.h"
#include "services/lab/trial/trial_setup.h"
#include "services/route/route.h"

namespace trailcast::trial {

// Returns "indoor-default-webcam-wide-trial3.mcap", with the push if there is one.
[[nodiscard]] std::filesystem::path TrialLogName(const TrialSetup& setup,
                                                 const TrialCase& trial_case, int trial,
                                                 int visit = 0);

// Begins the log of one trial in the folder that the options name, which is made. Without a folder,
// nothing is written.
[[nodiscard]] Result<agent::Diagnosis> OpenTrialLog(const TrialSetup& setup,
                                                    const TrialCase& trial_case,
                                                    const TrialOptions& options, int trial,
                                                    int visit, const route::RouteInfo& route);

}  // namespace trailcast::trial
