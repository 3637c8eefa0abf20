#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "agent/tool/path_judge.h"
#include "agent/tool/trial_report.h"
#include "agent/tool/trial_setup.h"
#include "agent/tool/trial_teach.h"
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

// Drives, by the number of the trial (from 1), the scout whose route its followers get: once for
// all cases that differ only in who follows. Threads may ask at a time; the first one drives.
class Teachings {
 public:
  Teachings(const TrialSetup& setup, const TrialOptions& options);

  // `on_progress` as in RunTrial; not called when somebody else drove.
  [[nodiscard]] Result<std::shared_ptr<const Taught>> Get(const TrialCase& trial_case, int trial,
                                                          const TrialProgress& on_progress);
  // Which of Taught::routes a method's followers get.
  [[nodiscard]] std::size_t RouteOf(agent::ReplayMethod method) const;

 private:
  struct Drive {
    std::once_flag once;
    Result<std::shared_ptr<const Taught>> taught;
  };
  const TrialSetup& setup_;
  std::uint64_t first_seed_;
  std::vector<bool> as_printed_;                         // of each of Taught::routes
  std::mutex mutex_;                                     // guards drives_
  std::map<std::pair<std::string, int>, Drive> drives_;  // by camera and trial
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

}  // namespace trailcast::tool
