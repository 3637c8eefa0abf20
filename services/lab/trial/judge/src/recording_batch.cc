#include "services/lab/trial/judge/recording_batch.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <tuple>
#include <utility>

#include "services/base/guarded.h"
#include "services/lab/trial/judge/src/recording_visits.h"
#include "services/lab/trial/trial_setup.h"

namespace trailcast::trial {
namespace {

// The share of a pair's work that is done once its route is taught, and once the route's own turns
// are known.
constexpr double kTaughtShare = 0.1;  // before the visits
constexpr double kTeachShare = 0.2;
constexpr double kOwnShare = 0.5;

// The threads' common state: the next pair, the routes taught, and the outcomes.
class Batch {
 public:
  Batch(const std::vector<RecordingPair>& pairs, const RecordingOptions& options,
        const RecordingProgress& on_progress)
      : pairs_(pairs),
        options_(options),
        on_progress_(on_progress),
        outcomes_(pairs.size()),
        shares_(pairs.size(), 0.0) {}

  // Does pairs until none is left; each thread runs this.
  void Work() {
    for (;;) {
      const std::size_t index = next_.fetch_add(1);
      if (index >= pairs_.size()) return;
      Result<RecordingOutcome> outcome = Guarded("judging a pair", [&] { return Run(index); });
      const std::scoped_lock lock(mutex_);
      outcomes_[index].emplace(std::move(outcome));
      ++ended_;
      Tell(index, 1.0);
    }
  }

  // Only after all threads have ended.
  std::vector<Result<RecordingOutcome>> Take() {
    std::vector<Result<RecordingOutcome>> taken;
    for (std::optional<Result<RecordingOutcome>>& outcome : outcomes_) {
      taken.push_back(*std::move(outcome));
    }
    return taken;
  }

 private:
  // The results that all replays on one recording share. The first thread that needs one makes it.
  struct Teaching {
    std::once_flag taught_once;
    Result<TaughtRecording> taught = Fail(ErrorCode::kInternal, "not taught yet");
    std::once_flag own_once;
    Result<std::vector<std::optional<double>>> own_turns_rad;
  };

  Result<RecordingOutcome> Run(std::size_t index) {
    const RecordingPair& pair = pairs_[index];
    Teaching& teaching = TeachingOf(pair);
    std::call_once(teaching.taught_once, [&] {
      teaching.taught = TeachRecording(pair.teach, TeachingFor(options_.method),
                                       Telling(index, 0.0, kTaughtShare));
      if (!teaching.taught || pair.visits.empty()) return;
      const auto visited =
          VisitRoute(pair, options_, Telling(index, kTaughtShare, kTeachShare), *teaching.taught);
      if (!visited) teaching.taught = tl::unexpected(visited.error());
    });
    if (!teaching.taught) {
      return About(teaching.taught.error(), "teaching " + pair.teach.frames.string());
    }
    const bool sided = pair.kind == PairKind::kRight && !pair.reference.empty();
    if (sided) std::call_once(teaching.own_once, [&] { FindOwnTurns(index, teaching); });
    if (!teaching.own_turns_rad) return tl::unexpected(teaching.own_turns_rad.error());
    auto outcome = RunRecordingTrial(pair, *teaching.taught, *teaching.own_turns_rad, options_,
                                     Telling(index, kOwnShare, 1.0));
    if (!outcome) {
      return About(outcome.error(), fmt::format("{} on {}", pair.replay_name, pair.teach_name));
    }
    return outcome;
  }

  // Nobody needs to know for what a file is that is not there.
  static tl::unexpected<Error> About(const Error& error, const std::string& doing) {
    if (error.code == ErrorCode::kNotFound) return tl::unexpected(error);
    return Wrap(error, doing);
  }

  Teaching& TeachingOf(const RecordingPair& pair) {
    const std::scoped_lock lock(mutex_);
    std::string visits = pair.visits_disturbance;
    for (const agent::RecordedRun& visit : pair.visits)
      visits.append("+").append(visit.frames.string());
    return teachings_[{pair.teach.frames, pair.teach.odometry, pair.teach.rate_hz,
                       std::move(visits)}];
  }

  void FindOwnTurns(std::size_t index, Teaching& teaching) {
    const RecordingPair& pair = pairs_[index];
    RecordingPair identity;
    identity.kind = PairKind::kIdentity;
    identity.teach = identity.replay = pair.teach;
    RecordingOptions options = options_;
    options.logs.clear();
    teaching.own_turns_rad = RunRecordingTrial(identity, *teaching.taught, {}, options,
                                               Telling(index, kTeachShare, kOwnShare))
                                 .map(OwnTurns);
  }

  // Reports a part of a pair's work as its shares from `from` to `to`.
  std::function<void(double)> Telling(std::size_t index, double from, double to) {
    return [this, index, from, to](double share) {
      const std::scoped_lock lock(mutex_);
      Tell(index, from + (to - from) * share);
    };
  }

  // The caller must hold the lock.
  void Tell(std::size_t index, double share) {
    shares_[index] = share;
    double sum = 0.0;
    for (const double each : shares_) sum += each;
    if (on_progress_) on_progress_(sum / static_cast<double>(shares_.size()), ended_);
  }

  const std::vector<RecordingPair>& pairs_;
  const RecordingOptions& options_;
  const RecordingProgress& on_progress_;
  std::atomic<std::size_t> next_{0};
  std::mutex mutex_;  // guards everything below
  // By the recording, its odometry and frame rate, and its visitors.
  std::map<
      std::tuple<std::filesystem::path, std::filesystem::path, std::optional<double>, std::string>,
      Teaching>
      teachings_;
  std::vector<std::optional<Result<RecordingOutcome>>> outcomes_;
  std::vector<double> shares_;
  int ended_ = 0;
};

}  // namespace

std::vector<Result<RecordingOutcome>> RunRecordingTrials(const std::vector<RecordingPair>& pairs,
                                                         const RecordingOptions& options, int jobs,
                                                         const RecordingProgress& on_progress) {
  Batch batch(pairs, options, on_progress);
  {
    std::vector<std::jthread> threads;
    const int count = std::clamp(jobs, 1, std::max(1, static_cast<int>(pairs.size())));
    threads.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) threads.emplace_back([&] { batch.Work(); });
  }
  return batch.Take();
}

std::vector<Error> ErrorsOf(const std::vector<Result<RecordingOutcome>>& outcomes) {
  std::vector<Error> errors;
  std::vector<int> pairs;
  for (const Result<RecordingOutcome>& outcome : outcomes) {
    if (outcome) continue;
    const auto same = std::find_if(errors.begin(), errors.end(), [&](const Error& error) {
      return error.message == outcome.error().message;
    });
    if (same != errors.end()) {
      ++pairs[static_cast<std::size_t>(same - errors.begin())];
    } else {
      errors.push_back(outcome.error());
      pairs.push_back(1);
    }
  }
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (pairs[i] > 1) errors[i].message += fmt::format(" (so for {} pairs)", pairs[i]);
  }
  return errors;
}

}  // namespace trailcast::trial
