#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/path_judge.h"
#include "services/lab/trial/teachings.h"
#include "services/lab/trial/trial_report.h"
#include "services/lab/trial/trial_setup.h"
#include "services/refresh/visit.h"
#include "services/route/terrain_profile.h"

namespace trailcast::trial {

struct TrialOutcome {
  TrialRow row;
  TruePath taught;
  TruePath replayed;
  std::vector<route::TerrainStretch> ground{};  // of the taught one
};

// One of several visits.
struct TrialVisit {
  int number = 0;                           // from 1; 0: there is but one
  std::shared_ptr<const sim::World> world;  // as it is by then
  Spoiled spoiled = Spoiled::kNothing;
};

// One follower, and what it met with on the way.
struct Followed {
  TrialOutcome outcome;
  std::optional<refresh::Visit> met;
};

// What of a trial comes after teaching, with the route as it is given.
[[nodiscard]] Result<Followed> Follow(const TrialSetup& setup, const TrialCase& trial_case,
                                      const TrialOptions& options, int trial, const Taught& taught,
                                      const TaughtRoute& route, const TrialVisit& visit,
                                      const TrialProgress& on_progress);

// One trial in closed loop, in process, of what a scout taught before: what it taught goes through
// the route format's bytes, and another robot, drawn anew, follows, under a sun that has moved on
// where there is one; of several visits one after the other, each with a robot drawn anew. Truth
// goes to the judge alone. `trial` counts from 1; the same setup, options.seed and trial give the
// same outcomes, bit for bit, but for the CPU time. A robot that fails to arrive is an outcome, not
// an error; an error is a path that cannot be driven, or a session that refuses a frame.
[[nodiscard]] Result<std::vector<TrialOutcome>> RunTrial(const TrialSetup& setup,
                                                         const TrialCase& trial_case,
                                                         const TrialOptions& options, int trial,
                                                         Teachings& teachings,
                                                         const TrialProgress& on_progress);

}  // namespace trailcast::trial
