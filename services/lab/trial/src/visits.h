#pragma once

#include <memory>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/trial.h"

namespace trailcast::trial {

[[nodiscard]] Result<std::shared_ptr<const sim::World>> WorldAfter(const TrialSetup& setup,
                                                                   double share);

// Runs options.visits followers one after the other, each in the place as it is by then. If the
// route is refreshed, each gets it as the one before has left it.
[[nodiscard]] Result<std::vector<TrialOutcome>> RunVisits(
    const TrialSetup& setup, const TrialCase& trial_case, const TrialOptions& options, int trial,
    const Taught& taught, const TaughtRoute& route, const TrialProgress& on_progress);

}  // namespace trailcast::trial
