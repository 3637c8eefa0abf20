#pragma once

#include "services/base/result.h"
#include "services/route/terrain_profile.h"
#include "services/trial/path_judge.h"
#include "services/trial/teachings.h"
#include "services/trial/trial_report.h"
#include "services/trial/trial_setup.h"

namespace trailcast::trial {

struct TrialOutcome {
  TrialRow row;
  TruePath taught;
  TruePath replayed;
  std::vector<route::TerrainStretch> ground{};  // of the taught one
};

// One replay in closed loop, in process, of what a scout taught before: what it taught goes through
// the route format's bytes, and another robot, drawn anew, follows, under a sun that has moved on
// where there is one. Truth goes to the judge alone. `trial` counts from 1; the same setup,
// options.seed and trial give the same outcome, bit for bit, but for the CPU time. A robot that
// fails to arrive is an outcome, not an error; an error is a path that cannot be driven, or a
// session that refuses a frame.
[[nodiscard]] Result<TrialOutcome> RunTrial(const TrialSetup& setup, const TrialCase& trial_case,
                                            const TrialOptions& options, int trial,
                                            Teachings& teachings, const TrialProgress& on_progress);

}  // namespace trailcast::trial
