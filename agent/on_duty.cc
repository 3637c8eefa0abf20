#include "agent/on_duty.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <utility>

#include "agent/device/standstill.h"
#include "agent/elsewhere.h"
#include "agent/glances.h"
#include "agent/hands.h"
#include "agent/link/followed_note.h"
#include "agent/link/lasting_exchange.h"
#include "agent/link/mission_desk.h"
#include "agent/link/now_desk.h"
#include "agent/link/outbox.h"
#include "agent/other_way.h"
#include "agent/routes_seen.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/exchange/publish.h"
#include "services/program/presence.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {
namespace {

using mission::State;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{50};
// Of what fails while a robot is free nobody needs to hear that is soon over, as when it starts.
constexpr std::chrono::seconds kAilsFor{2};
// A robot whose mission has ended on its way stands there yet, and others wait for it, as they do
// for one whose agent has ended.
constexpr std::chrono::seconds kStandsThere{60};
constexpr std::chrono::seconds kDeliverAgain{60};
// A robot that has found itself off its way is told another one by then, or has failed.
constexpr std::chrono::seconds kToldWithin{60};
// Of a route on which it looks for itself it drives nothing.
constexpr double kAtOnce_m = 0.01;
// Who does not know its camera turns so far to either side to see how large that shows things.
constexpr double kForLens_rad = 0.2;
constexpr const char* kWaitsForWord = "waits before a narrow stretch until a server lets it in";

exchange::AgentStatus FreeStatus(const AgentId& agent) {
  exchange::AgentStatus status;
  status.agent = agent;
  status.role = exchange::AgentRole::kFollower;
  return status;
}

mission::Task::Kind Kind(const MissionDesk::Current& current) {
  return current.tasks[current.task].kind;
}

// While a route is followed or taught, what comes in is heard in the thread of that link, and the
// one that runs this waits for it, or takes from the hands: neither needs a lock.
class OnDuty {
 public:
  OnDuty(RobotDevice& device, const OnDutyOptions& options,
         std::unique_ptr<exchange::RouteExchange> exchange)
      : device_(device),
        options_(options),
        glances_(options.agent),
        exchange_(glances_.Through(std::move(exchange))),
        now_desk_(options.agent, options.stop_file),
        followed_note_(options.agent),
        desk_(options.agent, options.missions_file),
        own_visit_(exchange_.Visit()),
        presence_(*own_visit_, FreeStatus(options.agent)) {
    presence_.FeelBy(options.vitals);
    exchange_.Tend({[this](const exchange::Message& message) { Hear(message); },
                    [this](exchange::RouteExchange& to) { Say(to); },
                    [this](const exchange::AgentStatus& status) { SawStatus(status); }});
  }

  [[nodiscard]] Result<void> Run();

 private:
  void Hear(const exchange::Message& message);
  void Say(exchange::RouteExchange& to);
  void SawStatus(const exchange::AgentStatus& status);
  void ShowFree();
  void AddDuty(exchange::AgentStatus& status) const;
  void NoteAilment(steady_clock::time_point now);
  void TellNews();
  [[nodiscard]] bool WaitsForWay() const;
  [[nodiscard]] bool Held() const { return now_desk_.hold().kind != Hold::Kind::kNone; }

  void Work();
  void WaitOn(const mission::Task& task);
  void WaitForWay();
  void GoOtherWay();
  void Follow(const mission::Task& task);
  void LookElsewhere();
  [[nodiscard]] FollowerOptions FollowerFor(const mission::Task& task);
  // None: there is nothing to judge, since it has failed before, or goes another way.
  [[nodiscard]] std::optional<Result<ReplayOutcome>> RunFollower(const FollowerOptions& follower);
  [[nodiscard]] bool LooksElsewhere(const Result<ReplayOutcome>& outcome);
  [[nodiscard]] std::vector<std::string> RoutesInView();
  void Refresh(const ReplayOutcome& outcome);
  void Teach(const mission::Task& task);
  [[nodiscard]] ScoutOptions ScoutFor(const mission::Task& task);
  void FindUndelivered();
  void Deliver();
  void Judge(const Result<ReplayOutcome>& outcome);
  void Done(const std::string& what = {});
  void End(State state, const std::string& why);
  void TellState(State state, const std::string& why);

  RobotDevice& device_;
  const OnDutyOptions& options_;
  Glances glances_;
  LastingExchange exchange_;
  NowDesk now_desk_;
  FollowedNote followed_note_;
  MissionDesk desk_;
  std::unique_ptr<exchange::RouteExchange> own_visit_;
  program::Presence presence_;
  bool claimed_ = false;
  bool following_ = false;
  bool delivering_ = false;
  bool undelivered_ = false;  // what it taught before
  steady_clock::time_point deliver_at_{};
  Hands* hands_ = nullptr;     // while it teaches
  std::optional<State> told_;  // of the mission under way
  std::string told_why_;
  bool was_under_way_ = false;  // in this following
  mission::Task driven_;        // what is followed
  // Of that: where it ends, and that it ends at once, since it goes another way.
  std::atomic<double> end_m_ = 0.0;
  std::atomic<bool> turned_off_ = false;
  std::string missed_;  // why it stands until it is told another way; empty: it need not
  Elsewhere elsewhere_;
  std::optional<steady_clock::time_point> told_until_;  // who has found itself there
  std::optional<steady_clock::time_point> wait_until_;
  std::optional<OwnLens> lens_;  // as the last following knew it
  std::string on_route_;         // where the last following ended
  std::optional<exchange::PlaceOnRoute> place_;
  steady_clock::time_point stands_until_{};
  std::string last_ = "free";
  std::optional<steady_clock::time_point> ails_since_;
  std::string ailment_;  // of the robot, while nothing drives it
};

void OnDuty::Hear(const exchange::Message& message) {
  desk_.Handle(message);
  if (desk_.TakeAmended()) GoOtherWay();
  if (claimed_) presence_.Handle(message);
  if (following_) return;
  const bool teaches = hands_ != nullptr;
  now_desk_.Handle(message, teaches ? on_route_ : "", NowUnixMs());
  if (!teaches) return;
  hands_->Tell(now_desk_.hold());
  const auto* drive = std::get_if<exchange::DriveCommand>(&message);
  if (drive != nullptr && drive->agent == options_.agent) {
    hands_->Hear(*drive, steady_clock::now());
  }
}

void OnDuty::Say(exchange::RouteExchange& to) {
  if (!claimed_) return;
  const auto now = steady_clock::now();
  // What cannot be handed over is said, or asked for, again.
  (void)exchange::PublishAll(to, desk_.Due(now, presence_.server().has_value()));
  TellNews();
  if (following_) return;
  (void)exchange::PublishAll(to, now_desk_.TakeAnswers());
  // Where no server was heard while it followed.
  if (presence_.server()) (void)exchange::PublishAll(to, followed_note_.Due(now));
  if (hands_ != nullptr) return hands_->Tell(now_desk_.hold());
  if (delivering_) return;
  ShowFree();
  presence_.Tick(now);
}

void OnDuty::TellNews() {
  for (const std::string& line : desk_.TakeNews()) spdlog::info("{}", line);
  if (following_) return;
  for (const std::string& line : now_desk_.TakeNews()) spdlog::warn("{}", line);
}

void OnDuty::ShowFree() {
  exchange::AgentStatus status;
  status.mode = exchange::AgentMode::kWaiting;
  const bool waits_for_way = WaitsForWay();
  status.detail = waits_for_way ? told_why_ : last_;
  AddDuty(status);
  if (!ailment_.empty() && Held()) {
    status.detail += "; " + ailment_;
  } else if (!ailment_.empty()) {
    status.mode = exchange::AgentMode::kFault;
    status.detail = ailment_;
  }
  if (waits_for_way || steady_clock::now() < stands_until_) {
    status.route = on_route_;
    status.place = place_;
  }
  presence_.Set(std::move(status));
}

// Whatever the robot does is told with how operators hold it.
void OnDuty::AddDuty(exchange::AgentStatus& status) const {
  status.hold = now_desk_.shown_hold();
  status.on_duty = true;
  if (Held()) status.detail = now_desk_.hold().text;
}

// Nobody asks for frames, so nobody else notices.
void OnDuty::NoteAilment(steady_clock::time_point now) {
  std::string ailment = device_.Ailment();
  if (ailment.empty()) {
    ails_since_.reset();
  } else if (!ails_since_) {
    ails_since_ = now;
  }
  if (!ails_since_ || now - *ails_since_ < kAilsFor) ailment.clear();
  if (ailment_.empty() && !ailment.empty()) spdlog::warn("the robot has failed: {}", ailment);
  if (!ailment_.empty() && ailment.empty()) spdlog::info("over: {}", ailment_);
  ailment_ = std::move(ailment);
}

void OnDuty::TellState(State state, const std::string& why) {
  // Why it stands may change, as from paused to stopped; how far a route is fetched is no news.
  const bool same_reason = state != State::kPaused || why == told_why_;
  if (told_ == state && same_reason) return;
  told_ = state;
  told_why_ = why;
  desk_.Tell(state, why);
}

// What follower or scout tells of itself is what becomes of the mission.
void OnDuty::SawStatus(const exchange::AgentStatus& status) {
  const bool at_work = following_ || hands_ != nullptr;
  if (!at_work || !desk_.current()) return;
  on_route_ = status.route;
  place_ = status.place;
  if (Held()) {
    TellState(State::kPaused, now_desk_.hold().text);
  } else if (elsewhere_.looks()) {
    TellState(State::kFetching,
              fmt::format("{}; looks whether it is on {}", elsewhere_.Lost(), on_route_));
  } else if (status.mode == exchange::AgentMode::kReplaying ||
             status.mode == exchange::AgentMode::kTeaching) {
    was_under_way_ = true;
    TellState(State::kUnderWay, "");
  } else if (!was_under_way_ && status.mode == exchange::AgentMode::kWaiting) {
    TellState(State::kFetching, status.detail);
  } else if (told_ == State::kPaused && status.mode == exchange::AgentMode::kWaiting) {
    TellState(State::kUnderWay, status.detail);
  }
}

Result<void> OnDuty::Run() {
  now_desk_.Load();
  if (auto loaded = desk_.Load(); !loaded) return loaded;
  // What comes meanwhile is heard by way of the exchange.
  if (auto claimed = presence_.Claim([](const exchange::Message&) {}, options_.stop); !claimed) {
    return claimed;
  }
  claimed_ = true;
  FindUndelivered();
  if (const auto& current = desk_.current();
      current && current->begun && Kind(*current) == mission::Task::Kind::kTeach) {
    End(State::kFailed,
        "its agent has started again in the middle of it: what was taught is kept, cut off, and "
        "no robot follows it unless an operator activates it");
  } else if (current && current->begun && !current->mission.goes_on) {
    now_desk_.Pause(fmt::format("its agent has started again in the middle of mission {}",
                                current->mission.id));
  }
  spdlog::info("on duty as '{}'", options_.agent.value());
  while (!options_.stop()) {
    (void)exchange_.Take(kWait);
    glances_.ShowIfWanted(device_);
    NoteAilment(steady_clock::now());
    if (desk_.current()) {
      Work();
    } else {
      now_desk_.ForgetCancelled();  // there was nothing to cancel
      if (undelivered_ && presence_.server() && steady_clock::now() >= deliver_at_) Deliver();
    }
  }
  (void)exchange_.Take(kWait);  // with which the last news is told
  exchange::AgentStatus last;
  last.mode = exchange::AgentMode::kStopped;
  last.detail = "stopped by a signal";
  presence_.Set(std::move(last));
  presence_.Publish();
  return {};
}

void OnDuty::Work() {
  const mission::Task task = desk_.current()->tasks[desk_.current()->task];
  if (now_desk_.hold().cancelled) {
    End(State::kCancelled, "cancelled by an operator");
  } else if (Held()) {
    if (told_until_) told_until_ = steady_clock::now() + kToldWithin;
    TellState(State::kPaused, now_desk_.hold().text);
  } else if (elsewhere_.looks()) {
    LookElsewhere();
  } else if (WaitsForWay()) {
    WaitForWay();
  } else if (task.kind == mission::Task::Kind::kWait) {
    WaitOn(task);
  } else if (task.kind == mission::Task::Kind::kTeach) {
    Teach(task);
  } else {
    Follow(task);
  }
}

void OnDuty::WaitOn(const mission::Task& task) {
  const auto now = steady_clock::now();
  TellState(State::kUnderWay, mission::ToText(task));
  if (!wait_until_) wait_until_ = now + ToMilliseconds(task.wait_s);
  if (now >= *wait_until_) Done();
}

bool OnDuty::WaitsForWay() const {
  const auto& current = desk_.current();
  if (!current) return false;
  const auto kind = Kind(*current);
  return !missed_.empty() || kind == mission::Task::Kind::kWaitWay ||
         kind == mission::Task::Kind::kWaitLane;
}

void OnDuty::WaitForWay() {
  const MissionDesk::Current& current = *desk_.current();
  if (told_until_ && steady_clock::now() > *told_until_) {
    return End(State::kFailed, fmt::format("{}; {}, and no server tells it another way within {} s",
                                           elsewhere_.Lost(), missed_, kToldWithin.count()));
  }
  if (missed_.empty() && Kind(current) == mission::Task::Kind::kWaitLane) {
    const bool told = current.because.starts_with(mission::kWaits);
    return TellState(State::kFetching, told ? current.because : kWaitsForWord);
  }
  TellState(State::kFetching,
            fmt::format("{}{}", mission::kAsksForWay, missed_.empty() ? current.because : missed_));
}

// In the thread that hears of it; what is followed meanwhile is told by end_m_ and turned_off_.
void OnDuty::GoOtherWay() {
  missed_.clear();
  told_until_.reset();
  if (!following_ || elsewhere_.looks()) {
    told_.reset();
    elsewhere_.End();
    turned_off_ = following_;
    return;
  }
  const auto& tasks = desk_.current()->tasks;
  const auto along_m = place_ ? std::optional(place_->along_m) : std::nullopt;
  const OtherWay other = FindOnWay(tasks, driven_, along_m);
  desk_.GoOnAt(other.task);
  const mission::Task& task = tasks[other.task];
  if (other.kind == OtherWay::Kind::kGoesOn) {
    driven_ = task;
    end_m_ = task.to_m;
    return;
  }
  if (other.kind == OtherWay::Kind::kMissed) {
    missed_ = fmt::format("it was told at {:.1f} m to leave {} at {:.1f} m", *along_m,
                          task.route.route, task.to_m);
  } else if (along_m && task.route.route == driven_.route.route) {
    desk_.BeginAt(*along_m);
  }
  turned_off_ = true;
}

FollowerOptions OnDuty::FollowerFor(const mission::Task& task) {
  FollowerOptions follower = options_.follower(task);
  follower.link.instance = presence_.status().instance;
  follower.link.now_desk = &now_desk_;
  follower.link.followed_note = &followed_note_;
  follower.link.vitals = options_.vitals;
  follower.link.stop = [this] { return options_.stop() || turned_off_; };
  follower.session.lens = lens_;
  follower.glances = &glances_;
  return follower;
}

std::optional<Result<ReplayOutcome>> OnDuty::RunFollower(const FollowerOptions& follower) {
  auto store = options_.open_store();
  if (!store) {
    End(State::kFailed, store.error().message);
    return std::nullopt;
  }
  was_under_way_ = false;
  ails_since_.reset();
  ailment_.clear();
  place_.reset();
  following_ = true;
  auto outcome = Replay(device_, follower, std::move(*store), exchange_.Visit());
  following_ = false;
  if (outcome) lens_ = outcome->lens;
  const bool arrived = outcome && outcome->success;
  stands_until_ = arrived ? steady_clock::time_point() : steady_clock::now() + kStandsThere;
  if (turned_off_.exchange(false)) return std::nullopt;
  return outcome;
}

void OnDuty::Follow(const mission::Task& task) {
  const MissionDesk::Current& current = *desk_.current();
  FollowerOptions follower = FollowerFor(task);
  follower.link.from_start = !current.begun;
  follower.link.begin_m = current.begun ? 0.0 : task.from_m;
  end_m_ = task.to_m;
  follower.end_m = [this] { return end_m_.load(); };
  // Of a stretch it is not to do another part.
  if (task.from_m > 0.0 || task.to_m > 0.0) follower.session.else_anywhere = false;
  if (!options_.logs.folder.empty()) {
    auto log = LogFor(options_.logs, {current.mission.id, current.task, current.lap});
    if (log) follower.diagnosis = *std::move(log);
    if (!log) spdlog::warn("{}", log.error().message);
  }
  driven_ = task;
  const auto outcome = RunFollower(follower);
  if (!outcome || LooksElsewhere(*outcome)) return;
  const bool arrived = *outcome && (*outcome)->success;
  // It had arrived when it heard that its order ends further on.
  const bool goes_on =
      arrived && end_m_ != task.to_m && place_ && end_m_ > place_->along_m + kOnWay_m;
  if (goes_on) return desk_.BeginAt(place_->along_m);
  if (arrived) Refresh(**outcome);
  Judge(*outcome);
}

// True: it looks elsewhere from now on. Who is only to drive a route may not be led over others.
bool OnDuty::LooksElsewhere(const Result<ReplayOutcome>& outcome) {
  if (!outcome || outcome->state != ToString(ReplayState::kLost)) return false;
  const MissionDesk::Current& current = *desk_.current();
  if (!mission::GoingIn(current.mission.orders) || !elsewhere_.MayBegin()) return false;
  elsewhere_.Begin(current.tasks, current.task,
                   fmt::format("{}: {}", outcome->state, outcome->reason), RoutesInView());
  spdlog::warn("{}", elsewhere_.Lost());
  told_.reset();
  return true;
}

// Of those that it holds.
std::vector<std::string> OnDuty::RoutesInView() {
  const auto store = options_.open_store();
  auto seen = device_.Next();
  if (!store || !seen || !*seen) return {};
  return RoutesSeen(**store, vision::DescribeForQuery((*seen)->image));
}

void OnDuty::LookElsewhere() {
  const mission::Task route = elsewhere_.route();
  spdlog::info("looks whether it is on {}", route.route.route);
  FollowerOptions follower = FollowerFor(route);
  // Looking all round takes most of a minute a route.
  double& turn_rad = follower.session.look_around_rad;
  turn_rad = lens_ ? 0.0 : std::min(turn_rad, kForLens_rad);
  follower.link.from_start = true;
  follower.session.anywhere = true;
  follower.end_m = [] { return kAtOnce_m; };
  const auto outcome = RunFollower(follower);
  if (!outcome) return;
  if (place_) {
    elsewhere_.End();
    missed_ = fmt::format("it finds itself on {} at {:.1f} m", on_route_, place_->along_m);
    told_until_ = steady_clock::now() + kToldWithin;
    told_.reset();
    return spdlog::info("{}", missed_);
  }
  if (*outcome && ((*outcome)->state == "STOPPED" || (*outcome)->state == "CANCELLED")) {
    elsewhere_.End();
    return Judge(*outcome);
  }
  if (elsewhere_.NotThere()) End(State::kFailed, elsewhere_.Lost());
}

// A server gets it while the robot is free.
void OnDuty::Refresh(const ReplayOutcome& outcome) {
  if (options_.refreshing == Refreshing::kOff || !outcome.visit) return;
  auto store = options_.open_scouts_store();
  if (!store) return spdlog::error("{}", store.error().message);
  const auto refreshed = StoreRefreshed(options_.agent, *outcome.followed, *outcome.visit,
                                        options_.refreshing, **store);
  TellRefreshed(refreshed);
  if (!refreshed || !options_.why_no_scout.empty()) return;
  undelivered_ = true;
  deliver_at_ = {};
}

ScoutOptions OnDuty::ScoutFor(const mission::Task& task) {
  ScoutOptions scout = options_.scout(task);
  scout.route = task.route.route;
  scout.tags = task.tags;
  scout.glances = &glances_;
  scout.link.instance = presence_.status().instance;
  scout.link.vitals = options_.vitals;
  scout.link.besides = [this](exchange::AgentStatus& status) { AddDuty(status); };
  return scout;
}

void OnDuty::Teach(const mission::Task& task) {
  if (!options_.why_no_scout.empty()) return End(State::kRefused, options_.why_no_scout);
  auto store = options_.open_scouts_store();
  if (!store) return End(State::kFailed, store.error().message);
  Hands hands;
  was_under_way_ = false;
  on_route_ = task.route.route;
  now_desk_.Teaches(true);
  hands_ = &hands;
  const auto taught =
      TeachByHand(device_, ScoutFor(task), hands, *std::move(store), exchange_.Visit());
  hands_ = nullptr;
  now_desk_.Teaches(false);
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

// Of teachings that earlier runs have left; those that were cut off end with what is there.
void OnDuty::FindUndelivered() {
  if (!options_.why_no_scout.empty()) return;
  const auto store = options_.open_scouts_store();
  if (!store) return spdlog::error("{}", store.error().message);
  const auto notes = Outbox(options_.agent, **store).LoadBacklog();
  if (!notes) return spdlog::error("{}", notes.error().message);
  for (const std::string& note : *notes) spdlog::info("{}", note);
  undelivered_ = !notes->empty();
}

// Missions wait for it, a little.
void OnDuty::Deliver() {
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

void OnDuty::Judge(const Result<ReplayOutcome>& outcome) {
  if (!outcome) {
    End(State::kFailed, outcome.error().message);
  } else if (outcome->success) {
    spdlog::info("arrived: {}", outcome->reason);
    Done();
  } else if (outcome->state == "STOPPED") {
    spdlog::warn("stopped in the middle of a mission: the next run takes it up");
  } else if (outcome->state == "CANCELLED") {
    End(State::kCancelled, outcome->reason);
  } else if (outcome->state == "REFUSED" ||
             (outcome->error && outcome->error->code == ErrorCode::kNotFound)) {
    End(State::kRefused, outcome->reason);
  } else {
    End(State::kFailed, fmt::format("{}: {}", outcome->state, outcome->reason));
  }
}

void OnDuty::Done(const std::string& what) {
  elsewhere_.Reset();
  wait_until_.reset();
  told_.reset();
  desk_.NoteDone();
  if (const auto& current = desk_.current(); current->task >= current->tasks.size()) {
    End(State::kArrived, what);
  }
}

void OnDuty::End(State state, const std::string& why) {
  last_ = fmt::format("free; mission {}: {}{}{}", desk_.current()->mission.id,
                      mission::ToString(state), why.empty() ? "" : ": ", why);
  desk_.Tell(state, why);
  told_.reset();
  elsewhere_.Reset();
  missed_.clear();
  told_until_.reset();
  wait_until_.reset();
  now_desk_.ForgetCancelled();
}

}  // namespace

Result<void> ServeOnDuty(RobotDevice& device, const OnDutyOptions& options,
                         std::unique_ptr<exchange::RouteExchange> exchange) {
  const Standstill standstill(device);
  OnDuty duty(device, options, std::move(exchange));
  return duty.Run();
}

}  // namespace trailcast::agent
