#pragma once

#include <functional>

#include "agent/tool/path_judge.h"
#include "agent/tool/trial_report.h"
#include "agent/tool/trial_setup.h"
#include "services/base/result.h"

namespace trailcast::tool {

struct TrialOutcome {
  TrialRow row;
  TruePath taught;
  TruePath replayed;
};

// Called with the share of the trial that is done, 0..1, now and then. False ends the trial early;
// its outcome is then of no use.
using TrialProgress = std::function<bool(double share)>;

// One teach and one replay in closed loop, in process: the scout is driven along the path by its
// operator, what it taught goes through the route format's bytes, and another robot, drawn anew,
// follows, under a sun that has moved on where there is one. Truth goes to the judge alone. `trial`
// counts from 1; the same setup, options.seed and trial give the same outcome, bit for bit, but for
// the CPU time. A robot that fails to arrive is an outcome, not an error; an error is a path that
// cannot be driven, or a session that refuses a frame.
[[nodiscard]] Result<TrialOutcome> RunTrial(const TrialSetup& setup, const TrialCase& trial_case,
                                            const TrialOptions& options, int trial,
                                            const TrialProgress& on_progress);

}  // namespace trailcast::tool
