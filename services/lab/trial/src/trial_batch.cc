#include "services/lab/trial/trial_batch.h"

#include <algorithm>
#include <atomic>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>

#include "services/base/guarded.h"

namespace trailcast::trial {
namespace {

// The threads' common state: the next trial, and the outcomes.
class Batch {
 public:
  Batch(const TrialSetup& setup, const TrialOptions& options, const BatchProgress& on_progress)
      : setup_(setup),
        options_(options),
        on_progress_(on_progress),
        teachings_(setup, options),
        outcomes_(setup.cases.size() * static_cast<std::size_t>(options.trials)),
        shares_(outcomes_.size(), 0.0) {}

  // Does trials until none is left or one failed to run at all; each thread runs this.
  void Work() {
    while (!broken_) {
      const std::size_t index = next_.fetch_add(1);
      if (index >= outcomes_.size()) return;
      const auto trials = static_cast<std::size_t>(options_.trials);
      Result<std::vector<TrialOutcome>> outcome = Guarded("a trial", [&] {
        return RunTrial(setup_, setup_.cases[index / trials], options_,
                        static_cast<int>(index % trials) + 1, teachings_, [&](double share) {
                          Note(index, share, nullptr);
                          return !broken_;
                        });
      });
      if (!outcome) broken_ = true;
      Note(index, 1.0, &outcome);
    }
  }

  Result<std::vector<TrialOutcome>> Take() {
    std::vector<TrialOutcome> outcomes;
    for (std::optional<Result<std::vector<TrialOutcome>>>& outcome : outcomes_) {
      if (!outcome) continue;  // it never began, after another one's error
      if (!*outcome) return tl::unexpected(outcome->error());
      std::move((*outcome)->begin(), (*outcome)->end(), std::back_inserter(outcomes));
    }
    return outcomes;
  }

 private:
  void Note(std::size_t index, double share, Result<std::vector<TrialOutcome>>* outcome) {
    const std::scoped_lock lock(mutex_);
    shares_[index] = share;
    if (outcome != nullptr) {
      ++ended_;
      arrived_ += *outcome && std::all_of((*outcome)->begin(), (*outcome)->end(),
                                          [](const TrialOutcome& each) { return each.row.arrived; })
                      ? 1
                      : 0;
      outcomes_[index].emplace(std::move(*outcome));
    }
    double sum = 0.0;
    for (const double each : shares_) sum += each;
    if (on_progress_) on_progress_(sum / static_cast<double>(shares_.size()), ended_, arrived_);
  }

  const TrialSetup& setup_;
  const TrialOptions& options_;
  const BatchProgress& on_progress_;
  Teachings teachings_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> broken_{false};
  std::mutex mutex_;  // guards everything below
  std::vector<std::optional<Result<std::vector<TrialOutcome>>>> outcomes_;
  std::vector<double> shares_;
  int ended_ = 0;
  int arrived_ = 0;
};

}  // namespace

Result<std::vector<TrialOutcome>> RunTrials(const TrialSetup& setup, const TrialOptions& options,
                                            const BatchProgress& on_progress) {
  Batch batch(setup, options, on_progress);
  {
    std::vector<std::jthread> threads;
    const int all = options.trials * static_cast<int>(setup.cases.size());
    const int jobs = std::clamp(options.jobs, 1, all);
    threads.reserve(static_cast<std::size_t>(jobs));
    for (int i = 0; i < jobs; ++i) threads.emplace_back([&] { batch.Work(); });
  }
  return batch.Take();
}

}  // namespace trailcast::trial
