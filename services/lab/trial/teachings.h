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

// Returns the seed of trial i, counted from 1, which decides everything drawn in it.
[[nodiscard]] inline std::uint64_t SeedOf(const TrialOptions& options, int trial) {
  return options.seed + static_cast<std::uint64_t>(trial - 1);
}

// The seeds of that trial's two robots.
struct TrialSeeds {
  std::uint64_t scout = 0;
  std::uint64_t follower = 0;
};
[[nodiscard]] TrialSeeds SeedsOf(const TrialOptions& options, int trial);

// Called now and then with the share of the trial that is done, 0..1. False ends the trial early;
// its outcome is then void.
using TrialProgress = std::function<bool(double share)>;

// Drives, by the number of the trial, the scout whose route its followers get: once for all cases
// that differ only in the follower. Several threads may ask at once; the first one drives.
class Teachings {
 public:
  Teachings(const TrialSetup& setup, const TrialOptions& options);

  // See RunTrial for `on_progress`, which is not called if another thread drove.
  [[nodiscard]] Result<std::shared_ptr<const Taught>> Get(const TrialCase& trial_case, int trial,
                                                          const TrialProgress& on_progress);
  // Returns the route for a method's followers.
  [[nodiscard]] const TaughtRoute& RouteFor(agent::ReplayMethod method, const Taught& taught) const;

 private:
  struct Drive {
    std::once_flag once;
    Result<std::shared_ptr<const Taught>> taught;
  };
  [[nodiscard]] std::size_t CutOf(agent::ReplayMethod method) const;

  const TrialSetup& setup_;
  const TrialOptions& options_;
  // One method for each way of cutting a drive into segments, in the order of Taught::routes.
  std::vector<agent::ReplayMethod> cuts_;
  std::mutex mutex_;                                     // guards drives_
  std::map<std::pair<std::string, int>, Drive> drives_;  // by camera and trial
};

}  // namespace trailcast::trial
