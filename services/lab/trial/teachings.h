#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/lab/trial/trial_setup.h"
#include "services/lab/trial/trial_teach.h"

namespace trailcast::trial {

// Trial i, counted from 1, is drawn from this alone.
[[nodiscard]] inline std::uint64_t SeedOf(const TrialOptions& options, int trial) {
  return options.seed + static_cast<std::uint64_t>(trial - 1);
}

// What that trial's two robots are drawn from.
struct TrialSeeds {
  std::uint64_t scout = 0;
  std::uint64_t follower = 0;
};
[[nodiscard]] TrialSeeds SeedsOf(const TrialOptions& options, int trial);

// Called with the share of the trial that is done, 0..1, now and then. False ends the trial early;
// its outcome is then of no use.
using TrialProgress = std::function<bool(double share)>;

// Drives, by the number of the trial, the scout whose route its followers get: once for all cases
// that differ only in who follows. Threads may ask at a time; the first one drives.
class Teachings {
 public:
  Teachings(const TrialSetup& setup, const TrialOptions& options);

  // `on_progress` as in RunTrial; not called when somebody else drove.
  [[nodiscard]] Result<std::shared_ptr<const Taught>> Get(const TrialCase& trial_case, int trial,
                                                          const TrialProgress& on_progress);
  // The one that a method's followers get.
  [[nodiscard]] const TaughtRoute& RouteFor(agent::ReplayMethod method, const Taught& taught) const;

 private:
  struct Drive {
    std::once_flag once;
    Result<std::shared_ptr<const Taught>> taught;
  };
  [[nodiscard]] std::size_t CutOf(agent::ReplayMethod method) const;

  const TrialSetup& setup_;
  const TrialOptions& options_;
  // One method for each way of cutting a drive into segments, as in Taught::routes.
  std::vector<agent::ReplayMethod> cuts_;
  std::mutex mutex_;                                     // guards drives_
  std::map<std::pair<std::string, int>, Drive> drives_;  // by camera and trial
};

}  // namespace trailcast::trial
