#include "services/lab/trial/trial.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "services/base/cpu_time.h"
#include "services/lab/sim/core/judge.h"
#include "services/lab/sim/core/random.h"
#include "services/lab/sim/core/simulated_robot.h"
#include "services/lab/trial/src/flawed_robot.h"
#include "services/lab/trial/src/scanned_way.h"
#include "services/lab/trial/src/served_route.h"
#include "services/lab/trial/src/standstill_watch.h"
#include "services/lab/trial/src/trial_log.h"
#include "services/lab/trial/src/visits.h"
#include "services/lab/trial/trial_teach.h"
#include "services/route/backwards.h"

namespace trailcast::trial {
namespace {

using agent::ReplayState;
using agent::ReplayStep;

constexpr double kPatience = 4.0;  // times the duration of teaching; beyond it, the robot goes
                                   // round in circles
constexpr double kPatience_s = 60.0;
constexpr int kProgressEvery = 15;   // frames
constexpr double kTeachShare = 0.4;  // of a trial's work
// These are for a follower that is set down anywhere: no start is in this last part of the path, it
// drives this far once it has found itself, and further beside the path it is not following.
constexpr double kLeftAtLeast_m = 2.0;
constexpr double kGoesOn_m = 5.0;
constexpr double kBeside_m = 1.0;
constexpr double kAbout_m = 0.1;
constexpr double kPutAside_m = 0.6;
constexpr double kLeastTold_m = 0.01;

Result<sim::SimulatedRobotOptions> FollowerOptions(const TrialSetup& setup, const sim::World& world,
                                                   const sim::CameraModel& camera,
                                                   const TrialSeeds& seeds,
                                                   const motion::Pose2& start) {
  sim::SimulatedRobotOptions options;
  options.camera = camera;
  options.start = start;
  options.start_z_max_m = setup.path.z_max_m;
  options.disturbances = setup.follower;
  options.seed = seeds.follower;
  if (setup.same_robot) options.robot_seed = seeds.scout;
  auto actors = setup.actors(sim::Role::kFollower, seeds.follower);
  if (!actors) return tl::unexpected(actors.error());
  options.actors = std::move(*actors);
  if (setup.sun_moves) {
    options.lighting = sim::WithMovedSun(world.lighting(), seeds.follower);
  }
  return options;
}

// Draws the place that such a robot is told, which is off by about `sigma_m`.
double DrawTold(double set_down_m, double sigma_m, std::uint64_t seed) {
  return std::max(kLeastTold_m, set_down_m + sigma_m * sim::Random(seed, "told").Normal());
}

// Draws a place along the taught path.
double DrawStart(const TruePath& taught, std::uint64_t seed) {
  return sim::Random(seed, "set down")
      .Uniform(0.0, std::max(0.0, taught.length_m() - kLeftAtLeast_m));
}

// Where a follower begins, and what it is set.
struct Outset {
  motion::Pose2 start;
  sim::CameraModel camera;
  bool backwards = false;
  bool anywhere = false;               // it is told no place
  std::optional<double> set_down_m{};  // along the path, if it only has to find itself
  std::optional<double> goal_m{};      // metres of the path from the end where it begins
};

Outset DrawOutset(const TrialSetup& setup, const TrialCase& trial_case, const TruePath& taught,
                  std::uint64_t seed) {
  const auto along = [&](double along_m) {
    return sim::PoseAlong(taught.points_m(), along_m, kAbout_m);
  };
  if (trial_case.cell) {
    const MatrixTask task = DrawTask(*trial_case.cell, taught, trial_case.follower_camera, seed);
    return {.start = task.start,
            .camera = task.camera,
            .backwards = task.backwards(),
            .anywhere = trial_case.cell->goal == MatrixCell::Goal::kAnyPoint,
            .goal_m = task.backwards() ? taught.length_m() - task.to_m : task.to_m};
  }
  Outset outset{.start = sim::StartPose(setup.path),
                .camera = trial_case.follower_camera,
                .backwards = setup.backwards};
  if (trial_case.start > 0) outset.set_down_m = DrawStart(taught, seed);
  if (outset.set_down_m) outset.start = along(*outset.set_down_m);
  if (setup.backwards) outset.start = along(taught.length_m());
  return outset;
}

using SessionOpener = std::function<Result<agent::ReplaySession>()>;

// A follower in closed loop, frame by frame, until it has ended in some way. It drives lap after
// lap, each with a session of its own, from where the one before has left the robot.
class Replaying {
 public:
  Replaying(sim::SimulatedRobot& robot, std::optional<FlawedRobot> flawed, const Taught& taught,
            agent::ReplaySession session, SessionOpener open_next, int laps,
            agent::Diagnosis diagnosis, double push_m, std::optional<double> set_down_m,
            std::optional<double> goal_m, std::optional<ScannedWay> way, Spoiled spoiled,
            std::uint64_t seed, std::optional<OdometrySpoiler> odometry)
      : robot_(robot),
        flawed_(std::move(flawed)),
        truth_(robot),
        judge_(taught.path),
        session_(std::move(session)),
        open_next_(std::move(open_next)),
        laps_(laps),
        diagnosis_(std::move(diagnosis)),
        push_at_m_(0.5 * taught.path.length_m()),
        push_m_(push_m),
        set_down_m_(set_down_m),
        goal_m_(goal_m),
        way_(std::move(way)),
        spoiled_(spoiled),
        seed_(seed),
        odometry_(std::move(odometry)),
        limit_s_(laps * (kPatience * taught.duration_s + kPatience_s)) {}

  // Does one frame. Returns false when the replay is over; `state` and `reason` then tell how it
  // ended.
  Result<bool> Step() {
    if (push_m_ != 0.0 && judge_.driven_m() >= push_at_m_) Push();
    std::optional<agent::Observation> observation = See();
    if (!observation) return !End("blind", "no picture came for long");
    observation->told = last_.command;
    if (observation->odometry && odometry_) {
      observation->odometry = odometry_->Tell(observation->stamp, *observation->odometry);
    } else {
      observation->odometry.reset();
    }
    Spoil(spoiled_, seed_, observation->image);
    if (Waits()) return !Ended(motion::Position(truth_.true_pose()));
    if (way_) observation->stands = way_->scanned();
    const double began_ms = ThreadCpuMs();
    auto step = session_.Observe(*observation);
    const double cpu_ms = ThreadCpuMs() - began_ms;
    cpu_ms_ += cpu_ms;
    ++frames_;
    if (!step) return tl::unexpected(step.error());
    last_ = std::move(*step);
    if (way_) last_.command = way_->Allow(last_.command);
    NotePassing();
    if (set_down_m_ && !found_) NoteFound();
    diagnosis_.Add({observation->stamp, observation->odometry, cpu_ms, off_m_}, session_, last_);
    if (Ended(motion::Position(truth_.true_pose()))) return false;
    if (last_.state == ReplayState::kArrived) return BeginLap();
    return true;
  }

  // Returns the share of all laps.
  [[nodiscard]] double progress() const {
    return (static_cast<double>(lap_ends_m_.size()) + last_.progress) / laps_;
  }
  // Fills in everything of the row that the replay decides.
  void Fill(TrialRow& row) const {
    row.verdict = judge_.verdict();
    if (goal_m_) row.verdict.final_error_m = OffGoal_m();
    row.lap_ends_m = lap_ends_m_;
    row.found_share = last_.found_share;
    row.hand_overs = last_.hand_overs;
    row.frames = frames_;
    row.ms_per_frame = frames_ > 0 ? cpu_ms_ / frames_ : 0.0;
    row.state = state_;
    row.reason = reason_;
    if (way_) row.scan = way_->figures();
    row.set_down = set_down_m_.has_value();
    row.found = found_;
    row.arrived = arrived_;
  }
  [[nodiscard]] const TruePath& path() const { return judge_.replayed(); }
  [[nodiscard]] std::optional<refresh::Visit> TakeVisit() {
    return arrived_ && !set_down_m_ ? session_.TakeVisit() : std::nullopt;
  }
  [[nodiscard]] Result<void> EndLog() { return diagnosis_.End(state_, reason_); }

 private:
  // Says whether it waits for an obstacle that its scanner sees.
  bool Waits() {
    if (!way_) return false;
    way_->Look(now_, truth_);
    const auto& waits = way_->waits();
    if (waits) last_.reason = *waits;
    if (waits.has_value() != waits_) diagnosis_.Note("robot", waits ? *waits : "drives again");
    return waits_ = waits.has_value();
  }
  void NotePassing() {
    if (last_.passing == passing_) return;
    passing_ = last_.passing;
    diagnosis_.Note("passing", passing_.empty() ? "nothing stands on the path" : passing_);
  }
  // Compares where a robot that was set down anywhere believes itself to be, as it sets off, with
  // where it is.
  void NoteFound() {
    if (last_.state != ReplayState::kFollowing) return;
    const double at_m =
        sim::Nearest(judge_.taught().points_m(), motion::Position(truth_.true_pose()),
                     *set_down_m_ - kGoesOn_m, *set_down_m_ + kGoesOn_m)
            .along_m;
    found_ = {*set_down_m_, Seconds(now_), TakenToBe_m() - at_m};
    diagnosis_.Note("found", fmt::format("{:+.2f} m from where it is", found_->off_m));
    found_after_m_ = judge_.driven_m();
  }
  // Returns where the robot takes itself to be, along the true path.
  [[nodiscard]] double TakenToBe_m() const {
    return last_.along_m.value_or(0.0) / session_.known_m() * judge_.taught().length_m();
  }
  [[nodiscard]] double OffGoal_m() const {
    return (sim::PointAlong(judge_.taught().points_m(), *goal_m_) - judge_.verdict().final_m)
        .norm();
  }
  // Returns the agent's next observation; until then the robot drives by its last command.
  std::optional<agent::Observation> See() {
    if (!flawed_) {
      sim::Observation seen = robot_.Step(last_.command);
      Judge(seen.stamp);
      return agent::Observation{seen.stamp, std::move(seen.image), seen.odometry};
    }
    auto seen = flawed_->Next(last_.command, [this](SensorTime now) { Judge(now); });
    for (const std::string& line : flawed_->TakeNews()) diagnosis_.Note("robot", line);
    return seen;
  }
  void Judge(SensorTime now) {
    now_ = now;
    off_m_ = judge_.Observe(motion::Position(truth_.true_pose()));
  }
  void Push() {
    diagnosis_.Note("pushed", fmt::format("{:.2f} m to the left, by the trial", push_m_));
    truth_.Shove({0.0, push_m_, 0.0});
    judge_.NotePush();
    push_m_ = 0.0;
  }
  Result<bool> BeginLap() {
    auto next = open_next_();
    if (!next) return tl::unexpected(next.error());
    session_ = std::move(*next);
    diagnosis_.Note("lap", fmt::format("{} of {} begins", lap_ends_m_.size() + 1, laps_));
    last_ = {};
    return true;
  }
  [[nodiscard]] std::string Where() const {
    const std::string lap = laps_ > 1 ? fmt::format("lap {}, ", lap_ends_m_.size() + 1) : "";
    return fmt::format("at {}segment {}, {:.0f} % of the way", lap, last_.segment.value(),
                       100.0 * last_.progress);
  }
  bool Ended(const Eigen::Vector2d& position_m) {
    if (found_ && judge_.driven_m() - found_after_m_ > kGoesOn_m) return EndFound();
    if (goal_m_ && (last_.state == ReplayState::kArrived ||
                    (last_.state == ReplayState::kFollowing && TakenToBe_m() >= *goal_m_))) {
      return EndAtGoal();
    }
    if (last_.state == ReplayState::kArrived) {
      if (set_down_m_) return EndFound();
      const double error_m = judge_.verdict().final_error_m;
      lap_ends_m_.push_back(error_m);
      if (error_m <= kArrivalRadius_m) {
        return static_cast<int>(lap_ends_m_.size()) == laps_ && Arrive("arrived");
      }
      return End("misplaced", fmt::format("says it arrived {:.1f} m from the end", error_m));
    }
    if (last_.state == ReplayState::kLost) {
      return End("lost", fmt::format("{}: {}", Where(), last_.reason));
    }
    if (off_m_ > kStrayLimit_m) {
      return End("strayed", fmt::format("{}: over {:.0f} m off the path", Where(), kStrayLimit_m));
    }
    if (standstill_.Stuck(position_m, Seconds(now_))) {
      return End("stuck",
                 fmt::format("{}: no further for {:.0f} s{}{}", Where(), StandstillWatch::kBound_s,
                             last_.reason.empty() ? "" : ": ", last_.reason));
    }
    if (Seconds(now_) > limit_s_) {
      return End("timeout", fmt::format("{}: still under way after {:.0f} s", Where(), limit_s_));
    }
    return false;
  }
  bool EndFound() {
    if (off_m_ <= kBeside_m) return Arrive("found");
    return End("strayed", fmt::format("{}: {:.1f} m off the path", Where(), off_m_));
  }
  bool EndAtGoal() {
    const double off_m = OffGoal_m();
    if (off_m <= kReached_m) return Arrive("arrived");
    return End("misplaced", fmt::format("says it arrived {:.1f} m from its goal", off_m));
  }
  bool Arrive(const char* state) {
    arrived_ = true;
    return End(state, "");
  }
  bool End(const char* state, std::string reason) {
    state_ = state;
    reason_ = std::move(reason);
    return true;
  }

  sim::SimulatedRobot& robot_;
  std::optional<FlawedRobot> flawed_;  // it drives robot_
  sim::Judge truth_;
  PathJudge judge_;
  agent::ReplaySession session_;
  SessionOpener open_next_;
  int laps_;
  std::vector<double> lap_ends_m_;  // distance from the taught end, for each lap
  agent::Diagnosis diagnosis_;
  double push_at_m_;
  double push_m_;                     // 0 if there is none, or it is done
  std::optional<double> set_down_m_;  // along the path; the robot is told no place
  std::optional<double> goal_m_;      // along the path, of a cell of the matrix
  std::optional<FoundFigures> found_;
  double found_after_m_ = 0.0;     // distance driven
  std::optional<ScannedWay> way_;  // for a follower with a scanner
  Spoiled spoiled_;
  std::uint64_t seed_;
  std::optional<OdometrySpoiler> odometry_;  // for a follower with odometry
  bool waits_ = false;
  std::string passing_;  // as it reports it
  double limit_s_;
  StandstillWatch standstill_;
  ReplayStep last_;  // a first Step without a command is a look at the start
  SensorTime now_{};
  double off_m_ = 0.0;  // from the taught path
  double cpu_ms_ = 0.0;
  int frames_ = 0;
  bool arrived_ = false;  // or found itself, if that was its task
  std::string state_;
  std::string reason_;
};

// Returns the reference for a robot that drives from the route's end to its beginning.
Taught TurnedRound(const Taught& taught) {
  Taught turned;
  const auto& points_m = taught.path.points_m();
  std::for_each(points_m.rbegin(), points_m.rend(),
                [&](const Eigen::Vector2d& point_m) { turned.path.Add(point_m); });
  turned.duration_s = taught.duration_s / route::kBackwardsPace;
  return turned;
}

TrialRow BeginRow(const TrialSetup& setup, const TrialCase& trial_case, std::uint64_t seed,
                  int trial, const Taught& taught, const TaughtRoute& route) {
  TrialRow row;
  row.scenario = setup.scenario;
  row.method = agent::ToString(trial_case.method);
  row.scout_camera = trial_case.scout_camera.name;
  row.follower_camera = trial_case.follower_camera.name;
  row.cell = trial_case.cell;
  row.same_robot = setup.same_robot;
  row.push_m = trial_case.push_m;
  row.flaw = trial_case.flaw;
  row.trial = trial;
  row.seed = seed;
  row.end_m = taught.path.end_m();
  row.segments = static_cast<int>(route.pieces.size());
  row.taught_m = taught.path.length_m();
  row.bytes_per_m = static_cast<double>(route.info.bytes) / row.taught_m;
  return row;
}

}  // namespace

Result<Followed> Follow(const TrialSetup& setup, const TrialCase& trial_case,
                        const TrialOptions& options, int trial, const Taught& taught,
                        const TaughtRoute& route, const TrialVisit& visit,
                        const TrialProgress& on_progress) {
  const std::uint64_t seed = SeedOf(options, trial);
  TrialSeeds seeds = SeedsOf(options, trial);
  if (visit.number > 1) {
    seeds.follower = sim::Random(seeds.follower, fmt::format("visit {}", visit.number)).Bits();
  }
  if (trial_case.start > 0) {
    seeds.follower = sim::Random(seeds.follower, fmt::format("start {}", trial_case.start)).Bits();
  }
  Outset outset = DrawOutset(setup, trial_case, taught.path, seeds.follower);
  if (visit.spoiled == Spoiled::kAside) {
    outset.start = motion::Compose(outset.start, {0.0, kPutAside_m, 0.0});
  }
  const RobotFlaws flaws =
      DrawFlaws(trial_case.flaw, outset.camera, taught.duration_s, seeds.follower);
  const auto options_of_follower =
      FollowerOptions(setup, *visit.world, flaws.camera, seeds, outset.start);
  if (!options_of_follower) return Wrap(options_of_follower.error(), "the follower");
  const auto robot = sim::SimulatedRobot::Create(visit.world, *options_of_follower);
  if (!robot) return Wrap(robot.error(), "the follower");
  const Result<TaughtRoute> served =
      trial_case.through_server ? FetchFromServer(route) : Result<TaughtRoute>(route);
  if (!served) return tl::unexpected(served.error());
  agent::ReplayMethodOptions follower = setup.follower_options;
  follower.method = trial_case.method;
  follower.anywhere = follower.anywhere || outset.anywhere;
  follower.else_anywhere = trial_case.cell.has_value();  // as an agent's is
  follower.intake.roll_deg += flaws.told_roll_deg;
  if (flaws.told_ahead_m) follower.camera_ahead_m = flaws.told_ahead_m;
  const auto open = [&] { return OpenSession(*served, follower, outset.backwards); };
  auto session = open();
  if (!session) return tl::unexpected(session.error());
  if (outset.set_down_m && options.told_m) {
    session->GoOnFrom({.along_m = DrawTold(*outset.set_down_m, *options.told_m, seeds.follower)});
  }
  auto diagnosis = OpenTrialLog(setup, trial_case, options, trial, visit.number, route.info);
  if (!diagnosis) return tl::unexpected(diagnosis.error());
  std::optional<FlawedRobot> flawed;
  if (!trial_case.flaw.empty()) flawed.emplace(**robot, flaws, seeds.follower);
  const Taught turned = outset.backwards ? TurnedRound(taught) : Taught();
  const Taught& judged_by = outset.backwards ? turned : taught;
  std::optional<OdometrySpoiler> odometry;
  if (setup.follower_has_odometry) {
    odometry.emplace(setup.odometry_noise, taught.duration_s, seeds.follower);
  }
  Replaying replaying(**robot, std::move(flawed), judged_by, std::move(*session), open, setup.laps,
                      std::move(*diagnosis), trial_case.push_m, outset.set_down_m, outset.goal_m,
                      setup.scanner ? std::optional<ScannedWay>(visit.world) : std::nullopt,
                      visit.spoiled, seeds.follower, std::move(odometry));
  for (int frame = 0;; ++frame) {
    const Result<bool> more = replaying.Step();
    if (!more) return Wrap(more.error(), "the follower");
    if (!*more) break;
    if (frame % kProgressEvery == 0 && !on_progress(replaying.progress())) {
      return Fail(ErrorCode::kUnavailable, "interrupted");
    }
  }
  if (auto ended = replaying.EndLog(); !ended) return tl::unexpected(ended.error());
  Followed followed{{BeginRow(setup, trial_case, seed, trial, judged_by, route), judged_by.path,
                     replaying.path(), route.ground.sections()},
                    replaying.TakeVisit()};
  followed.outcome.row.visit = visit.number;
  replaying.Fill(followed.outcome.row);
  return followed;
}

Result<std::vector<TrialOutcome>> RunTrial(const TrialSetup& setup, const TrialCase& trial_case,
                                           const TrialOptions& options, int trial,
                                           Teachings& teachings, const TrialProgress& on_progress) {
  const auto taught = teachings.Get(trial_case, trial,
                                    [&](double share) { return on_progress(kTeachShare * share); });
  if (!taught) return tl::unexpected(taught.error());
  const TaughtRoute& route = teachings.RouteFor(trial_case.method, **taught);
  const auto on_follow = [&](double share) {
    return on_progress(kTeachShare + (1.0 - kTeachShare) * share);
  };
  if (options.visits > 0) {
    return RunVisits(setup, trial_case, options, trial, **taught, route, on_follow);
  }
  auto world = WorldAfter(setup, 1.0);
  if (!world) return tl::unexpected(world.error());
  auto followed =
      Follow(setup, trial_case, options, trial, **taught, route, {0, std::move(*world)}, on_follow);
  if (!followed) return tl::unexpected(followed.error());
  std::vector<TrialOutcome> outcomes;
  outcomes.push_back(std::move(followed->outcome));
  return outcomes;
}

}  // namespace trailcast::trial
