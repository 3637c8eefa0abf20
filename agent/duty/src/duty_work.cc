// This part of Duty does the work: one order of the mission after the other.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "agent/duty/src/duty.h"
#include "agent/duty/src/rerouting.h"
#include "agent/duty/src/routes_seen.h"
#include "agent/link/outbox.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {
namespace {

using std::chrono::steady_clock;

// A robot whose mission ended on its way still stands there, and others wait for it as they do for
// one whose agent has ended.
constexpr std::chrono::seconds kStandsThere{60};
constexpr std::chrono::seconds kDeliverAgain{60};
// A robot that has found itself off its path is sent another one by then, or has failed.
constexpr std::chrono::seconds kToldWithin{60};
constexpr std::chrono::milliseconds kWait{50};
constexpr std::chrono::seconds kAnsweredWithin{3};
// A robot that only looks for itself on a route drives nothing of it.
constexpr double kAtOnce_m = 0.01;
// A robot that does not know its camera turns so far to either side to measure its magnification.
constexpr double kForLens_rad = 0.2;
constexpr const char* kWaitsForWord = "waits before a narrow place until a server lets it in";

}  // namespace

void Duty::Work() {
  const mission::Task task = mission_handler_.current()->tasks[mission_handler_.current()->task];
  // Anything else that the robot does ends these two.
  auto begun = std::move(next_);
  auto turning = std::move(turning_);
  if (now_handler_.hold().cancelled) {
    End(State::kCancelled, "cancelled by an operator");
  } else if (Held()) {
    if (told_until_) told_until_ = steady_clock::now() + kToldWithin;
    TellState(State::kPaused, now_handler_.hold().text);
  } else if (mission_handler_.current()->photos.any() && !photo_taker_) {
    End(State::kRefused, "it is to take photos, and its agent keeps none: its log says why");
  } else if (relocalisation_.looks()) {
    Relocalise();
  } else if (WaitsForWay()) {
    WaitForWay();
  } else if (task.kind == mission::Task::Kind::kTurn || turned_rad_ != 0.0) {
    Turn(task, std::move(turning));
  } else if (task.kind == mission::Task::Kind::kWait) {
    WaitOn(task);
  } else if (task.kind == mission::Task::Kind::kTeach) {
    Teach(task);
  } else {
    Follow(task, std::move(begun));
  }
}

void Duty::WaitOn(const mission::Task& task) {
  const auto now = steady_clock::now();
  TellState(State::kUnderWay, mission::ToText(task));
  if (!wait_until_) wait_until_ = now + ToMilliseconds(task.wait_s);
  if (now >= *wait_until_) Done();
}

void Duty::Turn(const mission::Task& task, std::unique_ptr<Turning> turning) {
  const bool is_order = task.kind == mission::Task::Kind::kTurn;
  if (!turning) {
    if (is_order && options_.follower(task).how.session.look_around_rad <= 0.0) {
      return End(State::kRefused,
                 "it is to turn on the spot, which its agent was told it may not: --look-around 0");
    }
    turning = std::make_unique<Turning>(device_, turned_rad_);
  }
  TellState(State::kUnderWay, mission::ToText(task));
  const auto there = turning->TurnOnTo(is_order ? task.turn_rad : 0.0);
  turned_rad_ = turning->turned_rad();
  if (!there) return End(State::kFailed, there.error().message);
  if (!*there) {
    turning_ = std::move(turning);
    return;
  }
  turned_rad_ = 0.0;
  if (is_order) Done();
}

bool Duty::WaitsForWay() const {
  const auto& current = mission_handler_.current();
  if (!current) return false;
  const auto kind = current->kind();
  return !missed_.empty() || kind == mission::Task::Kind::kWaitWay ||
         kind == mission::Task::Kind::kWaitLane;
}

void Duty::WaitForWay() {
  const MissionHandler::Current& current = *mission_handler_.current();
  if (told_until_ && steady_clock::now() > *told_until_) {
    return End(State::kFailed, fmt::format("{}; {}, and no server tells it another way within {} s",
                                           relocalisation_.Lost(), missed_, kToldWithin.count()));
  }
  if (missed_.empty() && current.kind() == mission::Task::Kind::kWaitLane) {
    const bool told = current.going.why == mission::Going::Why::kQueued;
    return TellState(State::kFetching, told ? current.going.because : kWaitsForWord,
                     mission::WaitsFor::kLane);
  }
  TellState(State::kFetching,
            "waits for a way: " + (missed_.empty() ? current.going.because : missed_),
            mission::WaitsFor::kWay);
}

// The link's thread calls this; end_m_ and turned_off_ tell the control loop.
void Duty::Reroute() {
  GoAlong();
  (void)tasks_after_.TryPut(TaskAfter());  // if it is full, the change-over looks at it again
}

void Duty::GoAlong() {
  missed_.clear();
  told_until_.reset();
  if (!following_ || relocalisation_.looks()) {
    told_.reset();
    relocalisation_.End();
    turned_off_ = following_;
    return;
  }
  const auto& tasks = mission_handler_.current()->tasks;
  const auto along_m = place_ ? std::optional(place_->along_m) : std::nullopt;
  const Rerouting other = FindOnPath(tasks, driven_, along_m);
  mission_handler_.GoOnAt(other.task);
  const mission::Task& task = tasks[other.task];
  if (other.kind == Rerouting::Kind::kGoesOn) {
    driven_ = task;
    end_m_ = task.to_m;
    return;
  }
  if (other.kind == Rerouting::Kind::kMissed) {
    missed_ = fmt::format("it was told at {:.1f} m to leave {} at {:.1f} m", *along_m,
                          task.route.route, task.to_m);
  } else if (along_m && task.route.route == driven_.route.route) {
    mission_handler_.BeginAt(*along_m);
  }
  turned_off_ = true;
}

FollowerOptions Duty::FollowerFor(const mission::Task& task) {
  FollowerOptions follower = options_.follower(task);
  follower.how.backwards = task.backwards;
  follower.link.instance = instance_;
  follower.link.now_handler = &now_handler_;
  follower.link.followed_note = &followed_note_;
  follower.link.vitals = options_.vitals;
  follower.link.stop = [this] { return options_.stop() || turned_off_; };
  follower.how.session.lens = lens_;
  follower.snapshots = &snapshots_;
  return follower;
}

std::optional<Result<ReplayOutcome>> Duty::RunFollower(const FollowerOptions& follower,
                                                       std::unique_ptr<NextPath> begun) {
  auto store = options_.open_store();
  if (!store) {
    End(State::kFailed, store.error().message);
    return std::nullopt;
  }
  was_under_way_ = begun != nullptr;
  ails_since_.reset();
  ailment_.clear();
  place_.reset();
  following_ = true;
  auto outcome = Replay(device_, follower, std::move(*store), exchange_.Visit(), std::move(begun));
  following_ = false;
  if (outcome) lens_ = outcome->lens;
  const bool arrived = outcome && outcome->success;
  stands_until_ = arrived ? steady_clock::time_point() : steady_clock::now() + kStandsThere;
  if (turned_off_.exchange(false)) return std::nullopt;
  return outcome;
}

// Returns the route that a robot on its way to a place drives after this one.
std::optional<mission::Task> Duty::TaskAfter() const {
  const auto& current = mission_handler_.current();
  if (!current || current->going.to.empty()) return std::nullopt;
  const std::size_t after = current->task + 1;
  if (after >= current->tasks.size()) return std::nullopt;
  const mission::Task& task = current->tasks[after];
  const bool changes_gear = task.backwards != current->tasks[current->task].backwards;
  return task.kind == mission::Task::Kind::kFollow && !changes_gear ? std::optional(task)
                                                                    : std::nullopt;
}

// The control loop's thread calls this. A robot that does not know its camera yet does not look for
// another route while it drives.
FollowerOptions::Next Duty::PrepareNext(const std::optional<OwnLens>& lens) {
  while (auto after = tasks_after_.TryGet()) {
    task_after_ = *std::move(after);
    made_ready_.clear();
    if (!task_after_) return FollowerOptions::Next(nullptr);
  }
  if (!task_after_ || !lens) return std::nullopt;
  const mission::Task task = *std::exchange(task_after_, std::nullopt);
  FollowerOptions follower = FollowerFor(task);
  follower.how.session.lens = lens;
  follower.how.session.else_anywhere = false;
  made_ready_ = mission::ToText(task);
  return std::make_unique<NextPath>(
      device_, RouteWish{0, follower.link.route, follower.link.revision, task.from_m},
      KnownPath(follower.how));
}

void Duty::Follow(const mission::Task& task, std::unique_ptr<NextPath> begun) {
  const MissionHandler::Current& current = *mission_handler_.current();
  if (begun && mission::ToText(task) != made_ready_) begun.reset();
  FollowerOptions follower = FollowerFor(task);
  follower.link.from_start = !current.begun;
  follower.link.begin_m = current.begun ? 0.0 : task.from_m;
  end_m_ = task.to_m;
  follower.end_m = [this] { return end_m_.load(); };
  // An order for a section does not allow the robot to drive other parts.
  if (task.from_m > 0.0 || task.to_m > 0.0) follower.how.session.else_anywhere = false;
  if (!options_.logs.folder.empty()) {
    auto log = LogFor(options_.logs, {current.mission.id, current.task, current.lap});
    if (log) {
      follower.diagnosis = *std::move(log);
    } else {
      spdlog::warn("{}", log.error().message);
    }
  }
  std::optional<PhotoRun> photos;
  if (current.photos.any()) {
    follower.photos = &photos.emplace(*photo_taker_, current.photos, options_.agent,
                                      current.mission.id, task.backwards);
  }
  driven_ = task;
  task_after_ = TaskAfter();
  made_ready_.clear();
  while (tasks_after_.TryGet()) {
  }
  follower.next = [this](const std::optional<OwnLens>& lens) { return PrepareNext(lens); };
  auto outcome = RunFollower(follower, std::move(begun));
  if (photos) {
    photos_taken_ += photos->taken();
    photographed_.merge(photos->Photographed());
  }
  if (!outcome || BeginsToRelocalise(*outcome)) return;
  const bool arrived = *outcome && (*outcome)->success;
  // It had already arrived when it heard that its order ends further on.
  const double on_m = place_ ? end_m_ - place_->along_m : 0.0;
  const bool goes_on =
      arrived && end_m_ != task.to_m && (task.backwards ? -on_m : on_m) > kOnPath_m;
  if (goes_on) return mission_handler_.BeginAt(place_->along_m);
  if (arrived && (*outcome)->visit) {
    visited_.push_back({*(*outcome)->followed, *std::move((*outcome)->visit)});
  }
  if (arrived) next_ = std::move((*outcome)->next);
  Judge(*outcome);
}

// Returns true if it looks on other routes from now on. An order to drive one route does not allow
// others.
bool Duty::BeginsToRelocalise(const Result<ReplayOutcome>& outcome) {
  if (!outcome || outcome->end != RunEnd::kLost) return false;
  if (mission_handler_.current()->going.to.empty() || !relocalisation_.MayBegin()) return false;
  // It hears the network while it asks about its view, and may be sent another path meanwhile, so
  // the order is read afterwards.
  const std::vector<std::string> seen = RoutesInView();
  const MissionHandler::Current& current = *mission_handler_.current();
  relocalisation_.Begin(current.tasks, current.task,
                        fmt::format("{}: {}", outcome->state, outcome->reason), seen);
  spdlog::warn("{}", relocalisation_.Lost());
  told_.reset();
  return true;
}

// These are its own routes, and those of a server.
std::vector<std::string> Duty::RoutesInView() {
  const auto store = options_.open_store();
  auto seen = device_.Next();
  if (!store || !seen || !*seen) return {};
  const route::View view = vision::DescribeForQuery((*seen)->image);
  std::vector<std::string> routes = RoutesSeen(**store, view);
  for (std::string& served : AskWhatIsInView(view)) routes.push_back(std::move(served));
  return routes;
}

std::vector<std::string> Duty::AskWhatIsInView(const route::View& view) {
  if (!presence_.server()) return {};
  question_.emplace(options_.agent, static_cast<std::uint64_t>(NowUnixMs()), view);
  const auto until = steady_clock::now() + kAnsweredWithin;
  // A question that cannot be sent is dropped, because its own routes remain.
  if (const auto asked = own_visit_->Publish(question_->request()); !asked) {
    spdlog::debug("{}", asked.error().message);
  }
  while (!question_->answered() && steady_clock::now() < until && !options_.stop()) {
    (void)exchange_.Take(kWait);
  }
  auto routes = question_->routes();
  question_.reset();
  return routes;
}

void Duty::Relocalise() {
  const mission::Task route = relocalisation_.route();
  spdlog::info("looks whether it is on {}", route.route.route);
  FollowerOptions follower = FollowerFor(route);
  // Looking all round takes most of a minute for each route.
  double& turn_rad = follower.how.session.look_around_rad;
  turn_rad = lens_ ? 0.0 : std::min(turn_rad, kForLens_rad);
  follower.link.from_start = true;
  follower.how.session.anywhere = true;
  follower.end_m = [] { return kAtOnce_m; };
  const auto outcome = RunFollower(follower);
  if (!outcome) return;
  if (place_) {
    relocalisation_.End();
    missed_ = fmt::format("it finds itself on {} at {:.1f} m", on_route_, place_->along_m);
    told_until_ = steady_clock::now() + kToldWithin;
    told_.reset();
    return spdlog::info("{}", missed_);
  }
  if (*outcome && ((*outcome)->end == RunEnd::kStopped || (*outcome)->end == RunEnd::kCancelled)) {
    relocalisation_.End();
    return Judge(*outcome);
  }
  if (relocalisation_.NotThere()) {
    End(State::kFailed, relocalisation_.Lost(), mission::WaitsFor::kPlace);
  }
}

// A server gets the revision while the robot is free.
void Duty::RefreshVisited() {
  const auto visited = std::exchange(visited_, {});
  if (options_.refreshing == Refreshing::kOff || visited.empty()) return;
  auto store = options_.open_scouts_store();
  if (!store) return spdlog::error("{}", store.error().message);
  for (const Visited& one : visited) {
    const auto refreshed =
        StoreRefreshed(options_.agent, one.route, one.visit, options_.refreshing, **store);
    TellRefreshed(refreshed);
    if (!refreshed || !options_.why_no_scout.empty()) continue;
    undelivered_ = true;
    deliver_at_ = {};
  }
}

ScoutOptions Duty::ScoutFor(const mission::Task& task) {
  ScoutOptions scout = options_.scout(task);
  scout.route = task.route.route;
  scout.tags = task.tags;
  scout.snapshots = &snapshots_;
  scout.link.instance = instance_;
  scout.link.vitals = options_.vitals;
  scout.link.besides = [this](exchange::AgentStatus& status) { AddDuty(status); };
  return scout;
}

void Duty::Teach(const mission::Task& task) {
  if (!options_.why_no_scout.empty()) return End(State::kRefused, options_.why_no_scout);
  auto store = options_.open_scouts_store();
  if (!store) return End(State::kFailed, store.error().message);
  Teleoperation teleoperation;
  was_under_way_ = false;
  on_route_ = task.route.route;
  now_handler_.Teaches(true);
  teleoperation_ = &teleoperation;
  const auto taught =
      TeachByHand(device_, ScoutFor(task), teleoperation, *std::move(store), exchange_.Visit());
  teleoperation_ = nullptr;
  now_handler_.Teaches(false);
  stands_until_ = {};
  undelivered_ = !taught || !taught->delivered;
  deliver_at_ = {};
  if (!taught) return End(State::kFailed, taught.error().message);
  spdlog::info("{}", taught->text);
  switch (taught->end) {
    case Taught::End::kComplete:
      return Done(taught->text);
    case Taught::End::kDiscarded:
      return End(State::kCancelled, taught->text);
    case Taught::End::kInterrupted:
      return End(State::kFailed, "its agent was stopped; " + taught->text);
  }
}

// Finds teachings that earlier runs left. A teaching that was cut off ends with what is there.
void Duty::FindUndelivered() {
  if (!options_.why_no_scout.empty()) return;
  const auto store = options_.open_scouts_store();
  if (!store) return spdlog::error("{}", store.error().message);
  const auto notes = Outbox(options_.agent, **store).LoadBacklog();
  if (!notes) return spdlog::error("{}", notes.error().message);
  for (const std::string& note : *notes) spdlog::info("{}", note);
  undelivered_ = !notes->empty();
}

// Missions wait for it a little.
void Duty::Deliver() {
  deliver_at_ = steady_clock::now() + kDeliverAgain;
  auto store = options_.open_scouts_store();
  if (!store) return spdlog::error("{}", store.error().message);
  ScoutLinkOptions link = ScoutFor({}).link;
  link.besides = [this](exchange::AgentStatus& status) {
    status.mode = exchange::AgentMode::kWaiting;
    status.detail = "free; a server is given what it has taught";
    AddDuty(status);
  };
  delivering_ = true;
  const auto delivered = DeliverBacklog(link, *std::move(store), exchange_.Visit());
  delivering_ = false;
  undelivered_ = !delivered;
  if (!delivered) spdlog::warn("{}", delivered.error().message);
}

void Duty::Judge(const Result<ReplayOutcome>& outcome) {
  if (!outcome) {
    End(State::kFailed, outcome.error().message);
  } else if (outcome->success) {
    spdlog::info("arrived: {}", outcome->reason);
    Done();
  } else if (outcome->end == RunEnd::kStopped) {
    spdlog::warn("stopped in the middle of a mission: the next run takes it up");
  } else if (outcome->end == RunEnd::kCancelled) {
    End(State::kCancelled, outcome->reason);
  } else if (outcome->end == RunEnd::kRefused ||
             (outcome->error && outcome->error->code == ErrorCode::kNotFound)) {
    End(State::kRefused, outcome->reason);
  } else {
    const bool is_lost = outcome->end == RunEnd::kLost;
    End(State::kFailed, fmt::format("{}: {}", outcome->state, outcome->reason),
        is_lost ? mission::WaitsFor::kPlace : mission::WaitsFor::kNothing);
  }
}

void Duty::Done(const std::string& what) {
  relocalisation_.Reset();
  wait_until_.reset();
  told_.reset();
  mission_handler_.NoteDone();
  if (const auto& current = mission_handler_.current(); current->task >= current->tasks.size()) {
    End(State::kArrived, what);
  }
}

// Returns what there is of the photos that its mission asks for, for people.
std::string Duty::PhotosText() const {
  const auto& current = *mission_handler_.current();
  if (!current.photos.any() || !photo_taker_) return "";
  if (photos_before_)
    return fmt::format("{} photos taken since its agent started again", photos_taken_);
  std::vector<std::string> missing;
  for (const mission::PhotoPlace& place : current.photos.at) {
    std::string words = ToText(place);
    if (!photographed_.contains(words)) missing.push_back(std::move(words));
  }
  std::string text = fmt::format("{} photos taken", photos_taken_);
  if (!missing.empty()) text += fmt::format(", none at {}", fmt::join(missing, ", "));
  return text;
}

void Duty::End(State state, const std::string& told, mission::WaitsFor waits_for) {
  const std::string photos = state == State::kRefused ? "" : PhotosText();
  const std::string why = told.empty() || photos.empty() ? told + photos : told + "; " + photos;
  photos_taken_ = 0;
  photographed_.clear();
  photos_before_ = false;
  last_ = fmt::format("mission {}: {}{}{}", mission_handler_.current()->mission.id,
                      mission::ToString(state), why.empty() ? "" : ": ", why);
  mission_handler_.Tell(state, why, waits_for);
  told_.reset();
  relocalisation_.Reset();
  missed_.clear();
  told_until_.reset();
  wait_until_.reset();
  turned_rad_ = 0.0;
  now_handler_.ForgetCancelled();
}

}  // namespace trailcast::agent
