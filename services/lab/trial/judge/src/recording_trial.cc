#include "services/lab/trial/judge/recording_trial.h"

#include <algorithm>
#include <cctype>
#include <exception>
#include <utility>

#include "agent/diagnosis/diagnosis.h"
#include "services/base/cpu_time.h"
#include "services/base/file_name.h"
#include "services/lab/trial/judge/src/recording_view.h"
#include "services/lab/trial/trial_teach.h"

namespace trailcast::trial {
namespace {

using agent::ReplayState;

Claim ClaimOf(ReplayState state) {
  if (state == ReplayState::kFollowing) return Claim::kFollowing;
  if (state == ReplayState::kArrived) return Claim::kArrived;
  if (state == ReplayState::kLost) return Claim::kLost;
  return Claim::kUnsure;
}

RecordingRow BeginRow(const RecordingPair& pair, const RecordingOptions& options) {
  RecordingRow row;
  row.set = pair.set;
  row.kind = pair.kind;
  row.teach = pair.teach_name;
  for (const agent::RecordedRun& visit : pair.visits) {
    row.teach.append("+").append(visit.frames.filename().string());
  }
  row.replay = pair.replay_name;
  row.disturbance = pair.disturbance.empty() ? "none" : pair.disturbance;
  if (!pair.replay.odometry.empty()) {
    const bool is_wrong = !pair.odometry_noise.empty() && pair.odometry_noise != "none";
    row.disturbance += is_wrong ? ", odometry " + pair.odometry_noise : ", odometry";
  }
  row.method = agent::ToString(options.method);
  return row;
}

// Returns the reference; `frames` is the recording's length.
Result<Reference> ReferenceOf(const RecordingPair& pair, int frames) {
  if (!pair.reference.empty()) return ReadReference(pair.reference);
  if (pair.kind == PairKind::kIdentity) return IdentityReference(frames);
  return Reference{};
}

Result<Steering> SteeringOf(const RecordingPair& pair, const Disturbance& disturbance) {
  if (pair.steering.empty() || !KeepsSteering(disturbance)) return Steering{};
  return ReadSteering(pair.steering);
}

Result<agent::Diagnosis> OpenLog(const RecordingRow& row, const route::RouteInfo& route,
                                 const RecordingOptions& options) {
  agent::DiagnosisOptions files{.patient = true, .picture_every_s = 0.0};
  if (!options.logs.empty()) {
    std::error_code failed;
    std::filesystem::create_directories(options.logs, failed);
    files.log = options.logs / (FileStem(row) + ".mcap");
  }
  auto diagnosis = agent::Diagnosis::Open(files);
  if (diagnosis) diagnosis->Begin({route, "judged", row.replay, row.method});
  return diagnosis;
}

// Libraries' messages have several lines.
std::string OneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.pop_back();
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

// A replay, frame by frame, until the recording ends or the session fails.
class Replaying {
 public:
  Replaying(RecordingView& view, const TaughtRecording& taught, agent::ReplaySession session,
            agent::Diagnosis diagnosis)
      : view_(view),
        taught_(taught),
        session_(std::move(session)),
        diagnosis_(std::move(diagnosis)) {}

  Result<void> Run(RecordingOutcome& outcome, const std::function<void(double)>& on_progress) {
    const double all = static_cast<double>(view_.order().size());
    while (outcome.row.error.empty()) {
      const auto seen = view_.Next();
      if (!seen) return tl::unexpected(seen.error());
      if (!*seen) break;
      outcome.row.error = Step(**seen, outcome);
      on_progress(static_cast<double>(outcome.replayed.said.size()) / all);
    }
    const std::size_t frames = outcome.replayed.said.size();
    outcome.row.ms_per_frame = frames > 0 ? cpu_ms_ / static_cast<double>(frames) : 0.0;
    return diagnosis_.End(outcome.row.state, outcome.row.error);
  }

 private:
  // Returns what went wrong, or an empty text. An exception of the session is a fault that replays
  // are meant to find.
  std::string Step(const agent::Observation& seen, RecordingOutcome& outcome) {
    const double began_ms = ThreadCpuMs();
    Result<agent::ReplayStep> step = agent::ReplayStep{};
    try {
      step = session_.Observe(seen);
    } catch (const std::exception& exception) {
      return fmt::format("frame {}: {}", outcome.replayed.said.size(), OneLine(exception.what()));
    }
    const double cpu_ms = ThreadCpuMs() - began_ms;
    cpu_ms_ += cpu_ms;
    if (!step)
      return fmt::format("frame {}: {}", outcome.replayed.said.size(), step.error().message);
    diagnosis_.Add({seen.stamp, seen.odometry, cpu_ms, {}}, session_, *step);
    outcome.replayed.said.push_back(
        {ClaimOf(step->state), TaughtFrameAt(taught_.spans, step->progress), step->turn_rad});
    outcome.row.state = agent::ToString(step->state);
    outcome.states.push_back(outcome.row.state);
    return "";
  }

  RecordingView& view_;
  const TaughtRecording& taught_;
  agent::ReplaySession session_;
  agent::Diagnosis diagnosis_;
  double cpu_ms_ = 0.0;
};

Result<void> Follow(const TaughtRecording& taught, const RecordingOptions& options,
                    RecordingView& view, RecordingOutcome& outcome,
                    const std::function<void(double)>& on_progress) {
  if (!taught.route) {
    outcome.row.error = taught.route.error().message;
    return {};
  }
  outcome.row.segments = static_cast<int>(taught.route->pieces.size());
  outcome.row.visits = taught.visits;
  auto session =
      OpenSession(*taught.route, {.method = options.method, .anywhere = options.anywhere});
  if (!session) return tl::unexpected(session.error());
  auto diagnosis = OpenLog(outcome.row, taught.route->info, options);
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  return Replaying(view, taught, std::move(*session), std::move(*diagnosis))
      .Run(outcome, on_progress);
}

}  // namespace

std::string FileStem(const RecordingRow& row) {
  return ForFileName(
      fmt::format("{}-on-{}-{}-{}", row.replay, row.teach, row.disturbance, row.method));
}

std::vector<std::optional<double>> OwnTurns(const RecordingOutcome& identity) {
  std::vector<std::optional<double>> turns;
  for (const Said& said : identity.replayed.said) {
    const bool follows = said.claim == Claim::kFollowing;
    turns.push_back(follows ? std::optional(said.turn_rad) : std::nullopt);
  }
  return turns;
}

Result<RecordingOutcome> RunRecordingTrial(const RecordingPair& pair, const TaughtRecording& taught,
                                           const std::vector<std::optional<double>>& own_turns_rad,
                                           const RecordingOptions& options,
                                           const std::function<void(double share)>& on_progress) {
  const auto disturbance = ParseDisturbance(pair.disturbance);
  if (!disturbance) return tl::unexpected(disturbance.error());
  const auto noise = ParseOdometryNoise(pair.odometry_noise);
  if (!noise) return tl::unexpected(noise.error());
  auto view = RecordingView::Open(pair.replay, *disturbance, *noise, options.seed);
  if (!view) return tl::unexpected(view.error());
  const auto reference = ReferenceOf(pair, view->recorded_frames());
  if (!reference) return tl::unexpected(reference.error());
  const auto steering = SteeringOf(pair, *disturbance);
  if (!steering) return tl::unexpected(steering.error());
  RecordingOutcome outcome;
  outcome.row = BeginRow(pair, options);
  outcome.replayed.shown = view->order();
  outcome.replayed.teach_frames = taught.frames;
  outcome.replayed.stride = StrideOf(*disturbance);
  outcome.replayed.own_turns_rad = own_turns_rad;
  if (auto followed = Follow(taught, options, *view, outcome, on_progress); !followed) {
    return tl::unexpected(followed.error());
  }
  for (const std::string& each : view->TakeNews()) {
    outcome.row.news.push_back(fmt::format("{}: {}", outcome.row.replay, each));
  }
  JudgeOptions judging = options.judging;
  judging.rate_hz = view->rate_hz();
  judging.width_px = KeepsSides(*disturbance) ? view->width_px() : 0;
  outcome.row.verdict = Judge(outcome.replayed, *reference, *steering, judging);
  outcome.truth = AlignmentsOf(outcome.replayed, *reference);
  return outcome;
}

}  // namespace trailcast::trial
