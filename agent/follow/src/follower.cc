#include "agent/follow/follower.h"

#include <spdlog/spdlog.h>

#include <cmath>
#include <ctime>
#include <utility>

#include "agent/camera_view/snapshots.h"
#include "agent/device/fault_subscription.h"
#include "agent/device/standstill.h"
#include "agent/follow/known_path.h"
#include "agent/follow/src/progress_watch.h"
#include "agent/follow/src/stand.h"
#include "agent/follow/src/yielding.h"
#include "agent/photos/photo_taker.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// A robot further past the end than this was carried there.
constexpr double kDrivenPast_m = 1.0;
// How far it goes on along this route until it has found the one to which it changes over.
constexpr double kChangesWithin_m = 0.1;
// Learning a segment of another route takes a fraction of a millisecond, and the robot drives
// meanwhile.
constexpr int kLearntAtOnce = 4;
constexpr milliseconds kWakeUp{200};  // how soon a waiting follower notices a signal
// How often a robot that stands behind another reads its sensors.
constexpr milliseconds kStandingFrame{33};

// CPU time of the whole process: OpenCV may use other threads.
double CpuMs() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// Returns for people how a run ended; `last` is the state of its last step.
const char* StateText(RunEnd end, ReplayState last) {
  switch (end) {
    case RunEnd::kArrived:
      return "ARRIVED";
    case RunEnd::kLost:
      return "LOST";
    case RunEnd::kStuck:
      return "STUCK";
    case RunEnd::kRefused:
      return "REFUSED";
    case RunEnd::kWaiting:
      return "WAITING";
    case RunEnd::kRecording:
      return ToString(last);
    case RunEnd::kStopped:
      return "STOPPED";
    case RunEnd::kCancelled:
      return "CANCELLED";
    case RunEnd::kFailed:
      return "FAILED";
  }
  return "UNKNOWN";
}

// Returns how a run ends while the robot is in `state`.
RunEnd EndIn(ReplayState state) {
  if (state == ReplayState::kArrived) return RunEnd::kArrived;
  if (state == ReplayState::kLost) return RunEnd::kLost;
  return state == ReplayState::kWaiting ? RunEnd::kWaiting : RunEnd::kRecording;
}

// The control loop with its state.
class Loop {
 public:
  Loop(RobotDevice& device, const FollowerOptions& options, FollowerLink& link, Diagnosis diagnosis)
      : device_(device),
        options_(options),
        link_(link),
        diagnosis_(std::move(diagnosis)),
        watch_(options.stuck_after),
        yielding_(options.link.agent, options.keep_distance),
        path_(options.how) {}

  // Only before Run: the robot already drives along this.
  void DriveOn(NextPath::Begun begun);

  // Runs until there is no more to do. An error is final.
  [[nodiscard]] Result<void> Run(Standstill& standstill);
  [[nodiscard]] ReplayOutcome Outcome(const Result<void>& ran,
                                      const std::optional<route::RouteInfo>& route) &&;

 private:
  void BeginDiagnosis();
  [[nodiscard]] Result<void> TakeFeed();
  [[nodiscard]] Result<bool> WaitForFeed();
  [[nodiscard]] Result<bool> Step(const Observation& observation);
  [[nodiscard]] Result<ReplayStep> Decide(const Observation& observation);
  void HearNeighbours();
  [[nodiscard]] bool NothingToFollow() const;
  // Returns false if an operator has ended the run.
  [[nodiscard]] bool TakeHold();
  [[nodiscard]] bool Refuses();
  [[nodiscard]] double PastEnd_m(const ReplayStep& step, double end_m) const;
  // Says whether it has passed the end of its part of this route.
  [[nodiscard]] bool PassedEnd(const ReplayStep& step, double end_m) const;
  void PrepareNext();
  // Returns how far it may still drive past that end while it looks for the next route.
  [[nodiscard]] std::optional<double> LeftToLookForNext_m(const ReplayStep& step,
                                                          double end_m) const;
  [[nodiscard]] bool ChangesOver(const Observation& observation);
  [[nodiscard]] Result<bool> EndAt(double end_m);
  void ShowSnapshot(const ReplayStep& step);
  void TakePhoto(const ReplayStep& step, const image::GrayImage& picture);
  void ShowWaiting();
  void Tell(const ReplayStep& step);
  void TellTrouble(const RobotDevice::Halt& halt);
  bool End(RunEnd end, std::string reason);

  RobotDevice& device_;
  const FollowerOptions& options_;
  FollowerLink& link_;
  Diagnosis diagnosis_;
  ProgressWatch watch_;
  Yielding yielding_;
  Hold hold_;
  Stand stand_;  // while an operator holds the robot
  KnownPath path_;
  std::unique_ptr<NextPath> next_;
  std::uint32_t wishes_ = 0;            // for next routes
  bool wished_ = false;                 // the link has heard the last one
  bool changes_over_ = false;           // it drives along the next route
  std::optional<double> went_on_at_m_;  // where it then found itself
  bool fed_ = false;                    // since the last frame
  bool looked_ = false;                 // at this frame
  // Whether a failure or an obstacle holds the robot now, and did at the last step.
  bool held_ = false;
  bool was_held_ = false;
  std::optional<ReplayStep> last_;
  motion::VelocityCommand told_;  // the base's last command
  RunEnd end_ = RunEnd::kWaiting;
  std::string reason_;
  ReplayLog log_;
};

void Loop::DriveOn(NextPath::Begun begun) {
  path_ = std::move(begun.path);
  BeginDiagnosis();
  ReplayStep step = path_.OfRoute(std::move(begun.step));
  Tell(step);
  last_ = std::move(step);
}

void Loop::BeginDiagnosis() {
  diagnosis_.Begin({*path_.route(), options_.link.agent.value(), device_.camera(),
                    ToString(options_.how.session.method)});
}

Result<void> Loop::TakeFeed() {
  while (auto item = link_.TryTake()) {
    fed_ = true;
    const bool knew_route = path_.route().has_value();
    const bool knew_all = path_.complete();
    if (auto taken = path_.Take(*std::move(item)); !taken) return taken;
    if (!knew_route) BeginDiagnosis();
    if (knew_all || !path_.complete()) continue;
    if (const auto text = path_.NotKnown()) spdlog::warn("{}", *text);
    diagnosis_.Note("complete", fmt::format("all {} segments are known", path_.segments()));
  }
  return {};
}

bool Loop::NothingToFollow() const {
  // It begins with everything in its own store, so that runs over one store are the same each time.
  if (path_.segments() == 0 || path_.segments() < link_.held_before()) return true;
  if (path_.AwaitsAll()) return true;
  const bool complete = path_.complete();
  const auto& left = path_.left();
  if (left && !complete && path_.session()->known_m() <= left->along_m) return true;
  const bool waiting = last_ && last_->state == ReplayState::kWaiting;
  return waiting && !fed_ && !complete;
}

// Ends the run if the robot cannot drive the ground.
bool Loop::Refuses() {
  const auto refusal = path_.Refusal();
  if (refusal) End(RunEnd::kRefused, *refusal);
  return refusal.has_value();
}

bool Loop::TakeHold() {
  while (auto hold = link_.TryTakeHold()) hold_ = *std::move(hold);
  return !hold_.cancelled || End(RunEnd::kCancelled, "cancelled by an operator");
}

// Returns false if the run is over.
Result<bool> Loop::WaitForFeed() {
  auto began = steady_clock::now();
  auto known = path_.taken();
  while (NothingToFollow()) {
    if (std::exchange(known, path_.taken()) != path_.taken()) began = steady_clock::now();
    if (options_.link.stop()) return End(RunEnd::kStopped, "stopped by a signal");
    // Before the first segment, the link has bounds of its own and says more precisely what fails.
    const auto bound =
        options_.link.wait + (path_.session() ? milliseconds(0) : milliseconds(5000));
    if (steady_clock::now() - began > bound) {
      return End(RunEnd::kWaiting,
                 fmt::format("no further segment within {:.0f} s: only {} segments are known, and "
                             "nobody who holds the rest answers",
                             Seconds(options_.link.wait), path_.taken()));
    }
    link_.WaitForNews(kWakeUp);
    ShowWaiting();
    if (auto taken = TakeFeed(); !taken) return tl::unexpected(taken.error());
    if (!TakeHold()) return false;
  }
  return true;
}

Result<void> Loop::Run(Standstill& standstill) {
  const FaultSubscription subscription(
      device_, [this](const RobotDevice::Halt& halt) { TellTrouble(halt); });
  while (true) {
    if (options_.link.stop()) {
      End(RunEnd::kStopped, "stopped by a signal");
      return {};
    }
    if (auto taken = TakeFeed(); !taken) return taken;
    auto ready = WaitForFeed();
    if (!ready) return tl::unexpected(ready.error());
    if (!*ready || Refuses()) return {};
    if (const std::string& why = path_.superseded(); !why.empty()) {
      End(RunEnd::kLost, why);
      return {};
    }
    const bool stands =
        last_ && (last_->state == ReplayState::kYielding || last_->state == ReplayState::kHeld);
    if (stands) link_.WaitForNews(kStandingFrame);
    auto observation = device_.Next();
    if (!observation) return tl::unexpected(observation.error());
    if (!TakeHold()) return {};
    if (!*observation && options_.link.stop()) continue;
    if (!*observation) {
      End(last_ ? EndIn(last_->state) : RunEnd::kWaiting,
          last_ && !last_->reason.empty() ? last_->reason : "the recording ends");
      return {};
    }
    if (!options_.open_loop) (*observation)->told = told_;
    auto on = Step(**observation);
    if (!on) return tl::unexpected(on.error());
    if (changes_over_) standstill.Leave();
    if (!*on) return {};
  }
}

// Robots are ahead in the direction of driving.
void Loop::HearNeighbours() {
  while (auto neighbours = link_.TryTakeNeighbours()) {
    for (Neighbour& one : *neighbours) one.along_m = path_.OfRoute(one.along_m);
    yielding_.Hear(std::move(*neighbours));
  }
}

Result<ReplayStep> Loop::Decide(const Observation& observation) {
  HearNeighbours();
  const bool held = hold_.kind != Hold::Kind::kNone;
  looked_ = false;
  if (const ReplayStep* wish = held ? stand_.WithoutLooking(observation.stamp) : nullptr) {
    return StandingStep(*wish, ReplayState::kHeld, hold_.text);
  }
  const auto now = steady_clock::now();
  if (auto standing = yielding_.StandOn(observation.stamp, now)) return *standing;
  auto step = path_.session()->Observe(observation);
  if (!step) return step;
  looked_ = true;
  if (held && step->state != ReplayState::kLost) {
    stand_.Begin(*step, observation.stamp);
    return StandingStep(*std::move(step), ReplayState::kHeld, hold_.text);
  }
  stand_.End();
  return yielding_.Apply(path_.Comfortable(*std::move(step)), observation.stamp, now);
}

// Returns false if the run is over.
Result<bool> Loop::Step(const Observation& observation) {
  fed_ = false;
  const double before_ms = CpuMs();
  auto step = Decide(observation);
  const double cpu_ms = CpuMs() - before_ms;
  if (!step) return Wrap(step.error(), fmt::format("frame {}", log_.frames()));
  if (!looked_) path_.session()->Pass(observation);
  const bool held = std::exchange(was_held_, held_);
  const bool stuck = watch_.Stuck(observation.stamp, *step, held);
  step = path_.OfRoute(*std::move(step));
  const double end_m = options_.open_loop ? 0.0 : options_.end_m();
  const auto left_to_look_m = LeftToLookForNext_m(*step, end_m);
  if (left_to_look_m) step->command = next_->WhileItLooks(step->command, *left_to_look_m);
  if (auto driven = device_.Drive(step->command); !driven) return tl::unexpected(driven.error());
  told_ = step->command;
  link_.Report(*step);
  ShowSnapshot(*step);
  TakePhoto(*step, observation.image);
  if (observation.unknown.distance_m > 0.0) {
    diagnosis_.Note("odometry", fmt::format("jumped: {:.2f} m may have been driven meanwhile",
                                            observation.unknown.distance_m));
  }
  log_.Add(observation.stamp, *step, cpu_ms);
  diagnosis_.Add({observation.stamp, observation.odometry, cpu_ms, {}}, *path_.session(), *step);
  Tell(*step);
  last_ = std::move(*step);
  if (options_.open_loop) return true;
  if (left_to_look_m) return !ChangesOver(observation);
  PrepareNext();
  if (PassedEnd(*last_, end_m)) return EndAt(end_m);
  if (last_->state == ReplayState::kArrived || last_->state == ReplayState::kLost) {
    return End(EndIn(last_->state), last_->reason);
  }
  if (!stuck) return true;
  return End(RunEnd::kStuck,
             fmt::format("no progress for {} s in segment {}{}{}", options_.stuck_after.count(),
                         last_->segment.value(), last_->reason.empty() ? "" : ": ", last_->reason));
}

void Loop::PrepareNext() {
  if (!options_.next) return;
  // A robot that is sure of its path knows its camera if it ever does, and finds the next route
  // with that knowledge.
  const auto lens = path_.session()->lens();
  if (lens || last_->trust == Trust::kSure) {
    if (auto next = options_.next(lens)) {
      next_ = *std::move(next);
      wishes_ += 1;
      wished_ = false;
    }
  }
  if (!next_) return;
  if (!wished_) {
    RouteWish wish = next_->wish();
    wish.number = wishes_;
    wished_ = link_.Wish(std::move(wish));
  }
  for (int i = 0; i < kLearntAtOnce; ++i) {
    auto fed = link_.TryTakeAhead();
    if (!fed) return;
    if (fed->wish == wishes_ && !next_->Learn(std::move(fed->item))) return next_.reset();
  }
}

std::optional<double> Loop::LeftToLookForNext_m(const ReplayStep& step, double end_m) const {
  const bool sure = step.state == ReplayState::kFollowing && step.trust == Trust::kSure;
  if (!next_ || !next_->ready() || !sure || !PassedEnd(step, end_m)) return std::nullopt;
  const double left_m = kChangesWithin_m - PastEnd_m(step, end_m);
  return left_m >= 0.0 ? std::optional(left_m) : std::nullopt;
}

bool Loop::ChangesOver(const Observation& observation) {
  changes_over_ = next_->TakesOver(observation);
  if (changes_over_) {
    End(RunEnd::kArrived,
        fmt::format("{:.1f} m along the route, where it changed over", *last_->along_m));
  }
  return changes_over_;
}

Result<bool> Loop::EndAt(double end_m) {
  if (auto stood = device_.Drive({}); !stood) return tl::unexpected(stood.error());
  told_ = {};
  if (PastEnd_m(*last_, end_m) > kDrivenPast_m) {
    return End(RunEnd::kLost,
               fmt::format("it was to end {:.1f} m along the route, and finds itself at {:.1f} m: "
                           "was it carried there? Send it on from where it stands",
                           end_m, *last_->along_m));
  }
  return End(RunEnd::kArrived,
             fmt::format("{:.1f} m along the route, where it was to end", *last_->along_m));
}

double Loop::PastEnd_m(const ReplayStep& step, double end_m) const {
  const double past_m = *step.along_m - end_m;
  return options_.how.backwards ? -past_m : past_m;
}

// This includes a robot at the route's own end, and one that drives on by odometry alone.
bool Loop::PassedEnd(const ReplayStep& step, double end_m) const {
  const bool knows_where = step.state == ReplayState::kFollowing ||
                           step.state == ReplayState::kArrived ||
                           (step.state == ReplayState::kBlind && step.trust == Trust::kBlind);
  return end_m > 0.0 && knows_where && step.along_m && PastEnd_m(step, end_m) >= 0.0;
}

// It comes after the command, so that a viewer delays only the next frame, by the time of a copy.
void Loop::ShowSnapshot(const ReplayStep& step) {
  if (options_.snapshots == nullptr || !options_.snapshots->wanted()) return;
  SnapshotFrame frame;
  frame.picture = *path_.session()->picture();
  if (looked_) {
    frame.features = path_.session()->ViewFeatures(step);
    frame.stored = step.sight.stored;
    frame.turn_rad = step.turn_rad;
  }
  options_.snapshots->Show(std::move(frame));
}

// It comes after the command, too, and costs the next frame the time of a copy.
void Loop::TakePhoto(const ReplayStep& step, const image::GrayImage& picture) {
  if (options_.photos == nullptr || !step.along_m || step.saw_nothing) return;
  const bool arrived = step.state == ReplayState::kArrived;
  const bool knows_place =
      arrived || step.state == ReplayState::kFollowing || step.state == ReplayState::kBlind;
  if (!knows_place) return;
  options_.photos->Pass({*path_.route(), *step.along_m, step.trust == Trust::kSure, arrived},
                        picture);
}

void Loop::ShowWaiting() {
  if (options_.snapshots != nullptr) options_.snapshots->ShowIfWanted(device_);
}

void Loop::Tell(const ReplayStep& step) {
  if (path_.left() && !went_on_at_m_ && step.along_m) {
    went_on_at_m_ = step.along_m;
    spdlog::info("goes on {:.1f} m along the route, left at {:.1f} m", *went_on_at_m_,
                 path_.OfRoute(path_.left()->along_m));
  }
  if (!last_ || last_->state != step.state) {
    spdlog::info("{} in segment {}{}{}", ToString(step.state), step.segment.value(),
                 step.reason.empty() ? "" : ": ", step.reason);
  } else if (last_->segment != step.segment) {
    spdlog::info("segment {}: {} features", step.segment.value(), step.features);
  }
  if (!step.turned.empty() && (!last_ || last_->turned.empty())) {
    spdlog::warn("{}", step.turned);
    diagnosis_.Note("camera", step.turned);
  }
  const std::string before = last_ ? last_->passing : std::string();
  if (step.passing == before) return;
  const std::string now = step.passing.empty() ? "nothing stands on the path" : step.passing;
  spdlog::info("{}", now);
  diagnosis_.Note("passing", now);
}

// The robot stands and may drive on afterwards; meanwhile there are no steps to report.
void Loop::TellTrouble(const RobotDevice::Halt& halt) {
  diagnosis_.Note("robot", halt.what.empty() ? "drives again" : halt.what);
  held_ = !halt.what.empty();
  was_held_ = true;
  ReplayStep step = last_.value_or(ReplayStep{});
  step.command = {};
  (halt.fault ? step.robot_trouble : step.robot_waits_for) = halt.what;
  link_.Report(step);
}

bool Loop::End(RunEnd end, std::string reason) {
  end_ = end;
  reason_ = std::move(reason);
  return false;
}

ReplayOutcome Loop::Outcome(const Result<void>& ran,
                            const std::optional<route::RouteInfo>& route) && {
  ReplayOutcome outcome;
  if (!ran) {
    End(RunEnd::kFailed, ran.error().message);
    outcome.error = ran.error();
  }
  const bool arrived = end_ == RunEnd::kArrived;
  const bool to_its_end = options_.open_loop && log_.frames() > 0 && end_ != RunEnd::kStopped &&
                          !outcome.error && end_ != RunEnd::kLost;
  outcome.success = arrived || to_its_end;
  outcome.end = end_;
  const ReplayStep last = last_.value_or(ReplayStep{});
  outcome.state = StateText(end_, last.state);
  outcome.reason = reason_;
  outcome.diagnosed = diagnosis_.End(outcome.state, reason_);
  if (path_.session()) outcome.lens = path_.session()->lens();
  if (changes_over_) outcome.next = std::move(next_);
  if (arrived && path_.complete() && route) {
    outcome.visit = path_.session()->TakeVisit();
    if (outcome.visit) outcome.followed = route;
  }
  Summary& summary = outcome.summary;
  summary.Add("arrived", arrived ? "1" : "0");
  summary.Add("state", outcome.state);
  summary.Add("reason", reason_);
  summary.Add("route", route ? route->name : options_.link.route);
  summary.Add("segments", std::to_string(path_.segments()));
  summary.Add("segment", std::to_string(last.segment.value()));
  if (went_on_at_m_) summary.Add("went_on_at_m", fmt::format("{:.2f}", *went_on_at_m_));
  summary.Add("progress", fmt::format("{:.4f}", last.progress));
  summary.Add("found_share", fmt::format("{:.4f}", last.found_share));
  summary.Add("hand_overs", std::to_string(last.hand_overs));
  if (route) {
    summary.Add("metres", fmt::format("{:.2f}", route->length_m));
    summary.Add("bytes_per_m", route->length_m > 0.0
                                   ? fmt::format("{:.0f}", route->bytes / route->length_m)
                                   : "unknown");
  }
  summary.Add("frames", std::to_string(log_.frames()));
  summary.Add("ms_per_frame", fmt::format("{:.3f}", log_.MedianMs()));
  outcome.log = std::move(log_);
  return outcome;
}

exchange::AgentMode LastMode(const ReplayOutcome& outcome, bool open_loop) {
  using exchange::AgentMode;
  if (outcome.error) return AgentMode::kFault;
  if (outcome.end == RunEnd::kArrived) return AgentMode::kArrived;
  const bool ended = outcome.end == RunEnd::kStopped || outcome.end == RunEnd::kCancelled;
  if (ended || (open_loop && outcome.success)) return AgentMode::kStopped;
  return AgentMode::kFault;
}

}  // namespace

Result<ReplayOutcome> Replay(RobotDevice& device, const FollowerOptions& options,
                             std::unique_ptr<store::RouteStore> store,
                             std::unique_ptr<exchange::RouteExchange> exchange,
                             std::unique_ptr<NextPath> begun) {
  Standstill standstill(device);
  auto diagnosis = Diagnosis::Open(options.diagnosis);
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  FollowerLinkOptions as_told = options.link;
  as_told.notes_followed = !options.how.backwards;
  FollowerLink link(std::move(as_told), std::move(store), std::move(exchange));
  if (auto started = link.Start(); !started) return tl::unexpected(started.error());
  Loop loop(device, options, link, std::move(*diagnosis));
  if (begun) loop.DriveOn(begun->Take());
  const auto ran = loop.Run(standstill);
  link.Finish();
  ReplayOutcome outcome = std::move(loop).Outcome(ran, link.route());
  link.Close(LastMode(outcome, options.open_loop), outcome.reason);
  return outcome;
}

}  // namespace trailcast::agent
