#include "agent/duty/on_duty.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "agent/device/standstill.h"
#include "agent/duty/src/duty.h"
#include "services/base/unix_time.h"
#include "services/exchange/publish.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{50};
// A short failure of an idle robot, as when it starts, need not be reported.
constexpr std::chrono::seconds kAilsFor{2};

exchange::AgentStatus FreeStatus(const AgentId& agent) {
  exchange::AgentStatus status;
  status.agent = agent;
  status.role = exchange::AgentRole::kFollower;
  return status;
}

}  // namespace

Duty::Duty(RobotDevice& device, const OnDutyOptions& options,
           std::unique_ptr<exchange::RouteExchange> exchange)
    : device_(device),
      options_(options),
      snapshots_(options.agent),
      exchange_(snapshots_.Through(std::move(exchange))),
      now_handler_(options.agent, options.stop_file),
      followed_note_(options.agent),
      mission_handler_(options.agent, options.missions_file),
      own_visit_(exchange_.Visit()),
      presence_(*own_visit_, FreeStatus(options.agent)) {
  presence_.FeelBy(options.vitals);
  if (options.photo_folder != nullptr) {
    photo_taker_.emplace(*options.photo_folder);
    photo_sender_.emplace(options.agent, *options.photo_folder);
  }
  exchange_.Tend({[this](const exchange::Message& message) { Hear(message); },
                  [this](exchange::RouteExchange& to) { Say(to); },
                  [this](const exchange::AgentStatus& status) { SawStatus(status); }});
}

void Duty::Hear(const exchange::Message& message) {
  mission_handler_.Handle(message);
  if (mission_handler_.TakeAmended()) Reroute();
  if (claimed_) presence_.Handle(message);
  if (question_) question_->Hear(message);
  if (photo_sender_) photo_sender_->Handle(message, steady_clock::now());
  if (following_) return;
  const bool teaches = teleoperation_ != nullptr;
  now_handler_.Works(mission_handler_.current().has_value());
  now_handler_.MayBeSent(mission_handler_.has_keeper());
  now_handler_.Handle(message, teaches ? on_route_ : "", NowUnixMs());
  if (!teaches) return;
  teleoperation_->Tell(now_handler_.hold());
  const auto* drive = std::get_if<exchange::DriveCommand>(&message);
  if (drive != nullptr && drive->agent == options_.agent) {
    teleoperation_->Hear(*drive, steady_clock::now());
  }
}

void Duty::Say(exchange::RouteExchange& to) {
  if (!claimed_) return;
  const auto now = steady_clock::now();
  // Anything that cannot be sent is repeated, or asked for again.
  (void)exchange::PublishAll(to, mission_handler_.Due(now, presence_.server().has_value()));
  if (photo_sender_) {
    (void)exchange::PublishAll(to, photo_sender_->Due(now, presence_.server()));
  }
  TellNews();
  if (following_) return;
  (void)exchange::PublishAll(to, now_handler_.TakeAnswers());
  // This covers a robot that heard no server while it followed.
  if (presence_.server()) followed_note_.TellIfDue(to, now);
  if (teleoperation_ != nullptr) return teleoperation_->Tell(now_handler_.hold());
  if (delivering_) return;
  ShowFree();
  presence_.Tick(now);
}

void Duty::TellNews() {
  for (const std::string& line : mission_handler_.TakeNews()) spdlog::info("{}", line);
  if (photo_taker_) {
    for (const std::string& line : photo_taker_->TakeNews()) spdlog::warn("{}", line);
    for (const std::string& line : photo_sender_->TakeNews()) spdlog::warn("{}", line);
  }
  if (following_) return;
  for (const std::string& line : now_handler_.TakeNews()) spdlog::warn("{}", line);
}

void Duty::ShowFree() {
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

// Every status tells how operators hold the robot.
void Duty::AddDuty(exchange::AgentStatus& status) const {
  status.hold = now_handler_.shown_hold();
  status.on_duty = true;
  if (Held()) status.detail = now_handler_.hold().text;
}

// No frames are requested from an idle robot, so nobody else notices.
void Duty::NoteAilment(steady_clock::time_point now) {
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

void Duty::TellState(State state, const std::string& why, mission::WaitsFor waits_for) {
  // The reason for standing may change, as from paused to stopped, and ends when it drives on. The
  // progress of fetching is no news.
  const bool same_reason = state == State::kFetching || why == told_why_;
  if (told_ == state && told_waits_for_ == waits_for && same_reason) return;
  told_ = state;
  told_waits_for_ = waits_for;
  told_why_ = why;
  mission_handler_.Tell(state, why, waits_for);
}

// The follower's or scout's status is the mission's state.
void Duty::SawStatus(const exchange::AgentStatus& status) {
  const bool at_work = following_ || teleoperation_ != nullptr;
  if (!at_work || !mission_handler_.current()) return;
  on_route_ = status.route;
  place_ = status.place;
  if (Held()) {
    TellState(State::kPaused, now_handler_.hold().text);
  } else if (relocalisation_.looks()) {
    TellState(State::kFetching,
              fmt::format("{}; looks whether it is on {}", relocalisation_.Lost(), on_route_),
              mission::WaitsFor::kPlace);
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

Result<void> Duty::Run() {
  now_handler_.Load();
  if (auto loaded = mission_handler_.Load(); !loaded) return loaded;
  // The exchange hears what comes meanwhile.
  if (auto claimed = presence_.Claim([](const exchange::Message&) {}, options_.stop); !claimed) {
    return claimed;
  }
  claimed_ = true;
  instance_ = presence_.status().instance;
  FindUndelivered();
  photos_before_ = mission_handler_.current() && mission_handler_.current()->begun;
  if (const auto& current = mission_handler_.current();
      current && current->begun && current->kind() == mission::Task::Kind::kTeach) {
    End(State::kFailed,
        "its agent has started again in the middle of it: what was taught is kept, cut off, and "
        "no robot follows it unless an operator activates it");
  } else if (current && current->begun && !current->mission.goes_on) {
    now_handler_.Pause(fmt::format("its agent has started again in the middle of mission {}",
                                   current->mission.id));
  }
  spdlog::info("available as '{}'", options_.agent.value());
  while (!options_.stop()) {
    const bool drives = next_ || turning_;
    (void)exchange_.Take(drives ? milliseconds(0) : kWait);
    if (!drives) RefreshVisited();
    snapshots_.ShowIfWanted(device_);
    NoteAilment(steady_clock::now());
    if (mission_handler_.current()) {
      Work();
    } else {
      next_.reset();
      now_handler_.ForgetCancelled();
      if (undelivered_ && presence_.server() && steady_clock::now() >= deliver_at_) Deliver();
    }
  }
  (void)exchange_.Take(kWait);  // this sends the last news
  exchange::AgentStatus last;
  last.mode = exchange::AgentMode::kStopped;
  last.detail = "stopped by a signal";
  presence_.Set(std::move(last));
  presence_.Publish();
  return {};
}

Result<void> ServeOnDuty(RobotDevice& device, const OnDutyOptions& options,
                         std::unique_ptr<exchange::RouteExchange> exchange) {
  const Standstill standstill(device);
  Duty duty(device, options, std::move(exchange));
  return duty.Run();
}

}  // namespace trailcast::agent
