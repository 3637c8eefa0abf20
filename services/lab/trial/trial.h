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
  std::vector<route::TerrainSection> ground{};  // along the taught path
};

// One of several visits.
struct TrialVisit {
  int number = 0;                           // from 1; 0 if it is the only one
  std::shared_ptr<const sim::World> world;  // as it is by then
  Spoiled spoiled = Spoiled::kNothing;
};

// One follower's outcome, and its findings on the way.
struct Followed {
  TrialOutcome outcome;
  std::optional<refresh::Visit> met;
};

// Runs the part of a trial after teaching, with the given route.
[[nodiscard]] Result<Followed> Follow(const TrialSetup& setup, const TrialCase& trial_case,
                                      const TrialOptions& options, int trial, const Taught& taught,
                                      const TaughtRoute& route, const TrialVisit& visit,
                                      const TrialProgress& on_progress);

// Runs one trial in closed loop, in this process, with a scout's route. The route goes through its
// format's bytes, and another robot, drawn anew, follows it, under a sun that has moved on if there
// is one. Several visits come one after the other, each with a robot drawn anew. Only the judge
// gets the truth. `trial` counts from 1; the same setup, options.seed and trial give the same
// outcomes, bit for bit, except for the CPU time. A robot that does not arrive is an outcome; an
// error is a path that cannot be driven, or a session that refuses a frame.
[[nodiscard]] Result<std::vector<TrialOutcome>> RunTrial(const TrialSetup& setup,
                                                         const TrialCase& trial_case,
                                                         const TrialOptions& options, int trial,
                                                         Teachings& teachings,
                                                         const TrialProgress& on_progress);

}  // namespace trailcast::trial
