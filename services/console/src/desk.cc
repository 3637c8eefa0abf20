#include "services/console/desk.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/guarded.h"
#include "services/base/unix_time.h"
#include "services/console/src/api/errand.h"
#include "services/console/src/api/look_errand.h"
#include "services/exchange/bounds.h"
#include "services/fleet/draw.h"
#include "services/fleet/known_robot.h"
#include "services/fleet/sending.h"
#include "services/fleet/telling.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using exchange::Topic;
using std::chrono::milliseconds;

// A word that waits for the thread waits for this at most.
constexpr milliseconds kTakeWait{10};
// Servers, of what was heard of just now.
constexpr milliseconds kAskAgain{1000};
// Questions, whose answers may be long.
constexpr milliseconds kAskErrandAgain{500};
// Of a route that a robot is on.
constexpr std::uint32_t kRevisionsAsked = 100;
// Beyond an errand's own time: the thread itself does not run.
constexpr milliseconds kGrace{3000};

class TellErrand final : public ErrandFor<std::vector<fleet::RobotsWord>> {
 public:
  TellErrand(const AgentId& self, exchange::NowOrder order, const fleet::NowTarget& target,
             const std::string& reason, milliseconds timeout)
      : telling_(self, order, {target}, reason), target_(target), timeout_(timeout) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override {
    return {telling_.commands().begin(), telling_.commands().end()};
  }
  void Hear(const exchange::Message& message) override { telling_.Hear(message); }
  void Begin(FleetState& state, std::chrono::steady_clock::time_point now) override {
    for (const auto& [robot, last_seen] : state.MayMove(now)) {
      if (target_.whom == exchange::NowWhom::kAll || target_.name == robot.value()) {
        telling_.Expect(robot.value(), last_seen);
      }
    }
    for (const std::string& robot : state.Robots()) telling_.Note(robot);
    if (order() == exchange::NowOrder::kRelease) state.Release(AgentId(target_.name), now);
  }
  [[nodiscard]] bool IsOver(milliseconds since) const override {
    return since > timeout_ || telling_.AllAnswered(since);
  }
  void End(FleetState& state) override {
    if (order() != exchange::NowOrder::kStop) return;
    for (const fleet::RobotsWord& word : telling_.Words()) {
      if (word.answered) continue;
      state.KeepTelling(AgentId(word.robot), telling_.commands().front(), began, NowUnixMs());
    }
  }

 private:
  [[nodiscard]] Result<std::vector<fleet::RobotsWord>> Outcome() const override {
    auto words = telling_.Words();
    if (words.empty()) return Fail(ErrorCode::kNotFound, "no robot is heard");
    return words;
  }
  [[nodiscard]] exchange::NowOrder order() const { return telling_.commands().front().order; }

  fleet::Telling telling_;
  fleet::NowTarget target_;
  milliseconds timeout_;
};

class SendErrand final : public ErrandFor<mission::Report> {
 public:
  SendErrand(mission::Mission mission, milliseconds timeout)
      : sending_(std::move(mission)), timeout_(timeout) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override {
    return {sending_.mission()};
  }
  [[nodiscard]] milliseconds SayAgain() const override { return sending_.SayAgain(); }
  void Hear(const exchange::Message& message) override { (void)sending_.Hear(message); }
  [[nodiscard]] bool IsOver(milliseconds since) const override {
    return sending_.Answered(since, timeout_);
  }

 private:
  [[nodiscard]] Result<mission::Report> Outcome() const override {
    return sending_.Outcome(timeout_);
  }

  fleet::Sending sending_;
  milliseconds timeout_;
};

// A mission's first step: whether there is such a robot.
class WhoErrand final : public ErrandFor<std::optional<Error>> {
 public:
  explicit WhoErrand(AgentId robot) : robot_(std::move(robot)) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {}; }
  void Hear(const exchange::Message& /*message*/) override {}
  void Begin(FleetState& state, std::chrono::steady_clock::time_point /*now*/) override {
    if (!state.Knows(robot_)) unknown_ = fleet::UnknownRobot(robot_.value(), state.Robots());
  }
  [[nodiscard]] bool IsOver(milliseconds /*since*/) const override { return true; }

 private:
  [[nodiscard]] Result<std::optional<Error>> Outcome() const override { return unknown_; }

  AgentId robot_;
  std::optional<Error> unknown_;
};

// Done at once, by the desk's thread, with what is the thread's own.
template <typename Reply>
class LocalErrand final : public ErrandFor<Reply> {
 public:
  using Work = std::function<Result<Reply>(FleetState&, std::chrono::steady_clock::time_point)>;
  explicit LocalErrand(Work work) : work_(std::move(work)) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {}; }
  void Hear(const exchange::Message& /*message*/) override {}
  void Begin(FleetState& state, std::chrono::steady_clock::time_point now) override {
    done_ = work_(state, now);
  }
  [[nodiscard]] bool IsOver(milliseconds /*since*/) const override { return true; }

 private:
  [[nodiscard]] Result<Reply> Outcome() const override { return *done_; }

  Work work_;
  std::optional<Result<Reply>> done_;
};

// One of servers, over when the first has answered.
template <typename Request, typename Reply>
class Question final : public ErrandFor<Reply> {
 public:
  // `wrong`: what it is when a server says why not.
  Question(Request request, milliseconds timeout, ErrorCode wrong = ErrorCode::kUnavailable)
      : request_(std::move(request)), timeout_(timeout), wrong_(wrong) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {request_}; }
  [[nodiscard]] milliseconds SayAgain() const override { return kAskErrandAgain; }
  void Hear(const exchange::Message& message) override {
    const auto* reply = std::get_if<Reply>(&message);
    if (reply == nullptr || reply->client != request_.client) return;
    if (reply->request == request_.request) reply_ = *reply;
  }
  [[nodiscard]] bool IsOver(milliseconds since) const override {
    return reply_.has_value() || since > timeout_;
  }

 private:
  [[nodiscard]] Result<Reply> Outcome() const override {
    if (!reply_) return Fail(ErrorCode::kUnavailable, "no route server answers");
    if (reply_->error.empty()) return *reply_;
    return Fail(wrong_, "server '{}': {}", reply_->server.value(), reply_->error);
  }

  Request request_;
  milliseconds timeout_;
  ErrorCode wrong_;
  std::optional<Reply> reply_;
};
using MissionQuestion = Question<exchange::MissionRequest, exchange::MissionReply>;
using RouteQuestion = Question<exchange::CatalogRequest, exchange::CatalogReply>;
using RouteChange = Question<exchange::RouteEditRequest, exchange::CatalogReply>;
using NetworkQuestion = Question<exchange::NetworkRequest, exchange::NetworkReply>;
using NetworkChange = Question<exchange::NetworkEdit, exchange::NetworkReply>;

// Looks at the desk's own state, in its thread.
class MeasureErrand final : public ErrandFor<http::MetricsText> {
 public:
  explicit MeasureErrand(FleetState& state) : state_(state) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {}; }
  void Hear(const exchange::Message& /*message*/) override {}
  [[nodiscard]] bool IsOver(milliseconds /*since*/) const override { return true; }

 private:
  [[nodiscard]] Result<http::MetricsText> Outcome() const override {
    state_.Tick(std::chrono::steady_clock::now());
    http::MetricsText text;
    state_.Measure(text);
    return text;
  }

  FleetState& state_;
};

// `future`: of a result; shared or not.
template <typename Future>
auto Await(Future future, milliseconds timeout) {
  using Outcome = std::remove_cvref_t<decltype(future.get())>;
  if (future.wait_for(timeout + kGrace) == std::future_status::ready) return Outcome(future.get());
  return Outcome(Fail(ErrorCode::kUnavailable, "the console's link to the fleet hangs"));
}

tl::unexpected<Error> TooMuch() {
  return Fail(ErrorCode::kUnavailable, "the console has too much to do: try again in a moment");
}

}  // namespace

exchange::TopicUse ConsoleTopics() {
  return {.write = {Topic::kNow, Topic::kMissions, Topic::kMissionRequests, Topic::kCatalogRequests,
                    Topic::kRouteEdits, Topic::kDrives, Topic::kGlanceRequests,
                    Topic::kNetworkEdits, Topic::kNetworkRequests},
          .read = {Topic::kGlances, Topic::kNowAnswers, Topic::kMissionStates,
                   Topic::kMissionReplies, Topic::kCatalogReplies, Topic::kNetworkReplies},
          // Said again all the time: to confirm each would cost the radio as much again.
          .overhear = {Topic::kAgents}};
}

exchange::TopicUse LookingTopics() {
  return {.write = {Topic::kMissionRequests, Topic::kCatalogRequests, Topic::kGlanceRequests,
                    Topic::kNetworkRequests},
          .read = {Topic::kMissionReplies, Topic::kCatalogReplies, Topic::kGlances,
                   Topic::kNetworkReplies},
          .overhear = {Topic::kAgents}};
}

Desk::Desk(AgentId self, std::unique_ptr<exchange::RouteExchange> exchange, Options options)
    : self_(std::move(self)),
      options_(std::move(options)),
      exchange_(std::move(exchange)),
      state_(self_),
      alerts_(options_.alerts),
      thread_([this] { Run(); }) {}

Desk::~Desk() {
  Close();
  thread_.join();
}

void Desk::Close() {
  {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

template <typename AnErrand>
auto Desk::CarryOut(std::shared_ptr<AnErrand> errand, bool is_stop, milliseconds timeout) {
  auto future = errand->Future();
  using Outcome = decltype(future.get());
  if (!Take(std::move(errand), is_stop)) return Outcome(TooMuch());
  return Await(std::move(future), timeout);
}

Result<std::vector<fleet::RobotsWord>> Desk::Tell(exchange::NowOrder order,
                                                  const fleet::NowTarget& target,
                                                  const std::string& reason) {
  return CarryOut(
      std::make_shared<TellErrand>(self_, order, target, reason, options_.answer_within),
      order == exchange::NowOrder::kStop, options_.answer_within);
}

// Of whom nobody has heard here a server may have heard.
std::optional<Error> Desk::Unknown(const AgentId& robot) {
  auto unknown = CarryOut(std::make_shared<WhoErrand>(robot), false, milliseconds(0));
  if (!unknown || !*unknown) return std::nullopt;
  mission::Query of_robot;
  of_robot.agent = robot.value();
  const auto missions = Missions(of_robot);
  if (!missions || fleet::HasHeardOf(*missions, robot.value())) return std::nullopt;
  return *std::move(*unknown);
}

Result<mission::Report> Desk::Send(mission::Mission mission, bool also_unheard) {
  if (!also_unheard) {
    if (auto unknown = Unknown(mission.agent)) return tl::unexpected(*std::move(unknown));
  }
  mission.client = self_;
  return CarryOut(std::make_shared<SendErrand>(std::move(mission), options_.reply_within), false,
                  options_.reply_within);
}

Result<void> Desk::Forget(const AgentId& robot) {
  const auto done = CarryOut(
      std::make_shared<LocalErrand<std::monostate>>(
          [this, robot](FleetState& state, Clock::time_point now) -> Result<std::monostate> {
            const auto forgotten = state.Forget(robot, now);
            // Of one that was not heard since the console started there may be alerts of before.
            const bool had_alerts = (forgotten || forgotten.error().code == ErrorCode::kNotFound) &&
                                    alerts_.End(robot.value(), NowUnixMs());
            if (!forgotten && !had_alerts) return tl::unexpected(forgotten.error());
            return std::monostate{};
          }),
      false, milliseconds(0));
  if (!done) return tl::unexpected(done.error());
  return {};
}

Result<program::Json> Desk::AllAlerts() {
  return CarryOut(
      std::make_shared<LocalErrand<program::Json>>(
          [this](FleetState& /*state*/, Clock::time_point /*now*/) -> Result<program::Json> {
            return alerts_.AllShown();
          }),
      false, milliseconds(0));
}

Result<void> Desk::Acknowledge(const std::string& alert, const std::string& by) {
  const auto done =
      CarryOut(std::make_shared<LocalErrand<std::monostate>>(
                   [this, alert, by](FleetState& /*state*/,
                                     Clock::time_point /*now*/) -> Result<std::monostate> {
                     const auto acknowledged = alerts_.Acknowledge(alert, by, NowUnixMs());
                     if (!acknowledged) return tl::unexpected(acknowledged.error());
                     return std::monostate{};
                   }),
               false, milliseconds(0));
  if (!done) return tl::unexpected(done.error());
  return {};
}

Result<exchange::MissionReply> Desk::Missions(const mission::Query& query) {
  return AskHistory({.query = query});
}

Result<exchange::MissionReply> Desk::Commands(const mission::Query& query) {
  return AskHistory({.commands = true, .query = query});
}

Result<exchange::MissionReply> Desk::AskHistory(exchange::MissionRequest request) {
  request.client = self_;
  request.request = fleet::DrawNumber();
  return CarryOut(std::make_shared<MissionQuestion>(std::move(request), options_.reply_within),
                  false, options_.reply_within);
}

Result<exchange::CatalogReply> Desk::Routes(const route::RouteQuery& query) {
  const exchange::CatalogRequest request{self_, fleet::DrawNumber(), query};
  return CarryOut(std::make_shared<RouteQuestion>(request, options_.reply_within), false,
                  options_.reply_within);
}

Result<exchange::CatalogReply> Desk::Edit(const route::RouteEdit& edit) {
  const exchange::RouteEditRequest request{self_, fleet::DrawNumber(), edit};
  return CarryOut(
      std::make_shared<RouteChange>(request, options_.reply_within, ErrorCode::kConflict), false,
      options_.reply_within);
}

Result<exchange::NetworkReply> Desk::Network(const std::string& words, std::uint32_t first) {
  const exchange::NetworkRequest request{self_, fleet::DrawNumber(), words, first};
  return CarryOut(
      std::make_shared<NetworkQuestion>(request, options_.reply_within, ErrorCode::kConflict),
      false, options_.reply_within);
}

Result<exchange::NetworkReply> Desk::Join(const std::string& words) {
  const exchange::NetworkEdit edit{self_, fleet::DrawNumber(), words};
  return CarryOut(
      std::make_shared<NetworkChange>(edit, options_.reply_within, ErrorCode::kConflict), false,
      options_.reply_within);
}

Result<http::MetricsText> Desk::Measure() {
  auto text = CarryOut(std::make_shared<MeasureErrand>(state_), false, milliseconds(0));
  if (!text) return text;
  const std::scoped_lock lock(mutex_);
  text->Add("console_requests_refused_total", "counter",
            "Commands and questions that were one too many.", refused_);
  return text;
}

Result<std::shared_ptr<const exchange::Glance>> Desk::Look(const AgentId& robot) {
  const std::shared_future<Seen> future = LookUnderWay(robot);
  return future.valid() ? Await(future, LookErrand::kTimeout) : TooMuch();
}

std::shared_future<Desk::Seen> Desk::LookUnderWay(const AgentId& robot) {
  const std::scoped_lock lock(mutex_);
  if (closed_) return {};
  std::erase_if(looks_, [](const auto& look) {
    return look.second.wait_for(milliseconds(0)) == std::future_status::ready;
  });
  if (const auto look = looks_.find(robot); look != looks_.end()) return look->second;
  if (looks_.size() >= kMostLooks) return {};
  auto errand = std::make_shared<LookErrand>(self_, robot);
  std::shared_future<Seen> future = errand->Future().share();
  others_.push_back(std::move(errand));
  looks_.emplace(robot, future);
  return future;
}

bool Desk::Take(std::shared_ptr<Errand> errand, bool is_stop) {
  const std::scoped_lock lock(mutex_);
  if (closed_) return false;
  errand->counts = !is_stop;
  const bool too_many = is_stop ? stops_.size() >= kMostStops : under_way_ >= kMostErrands;
  if (too_many) {
    ++refused_;
    return false;
  }
  if (is_stop) {
    stops_.push_back(std::move(errand));
    return true;
  }
  ++under_way_;
  others_.push_back(std::move(errand));
  return true;
}

std::shared_ptr<const Desk::News> Desk::See(std::uint64_t number, milliseconds most) {
  std::unique_lock lock(mutex_);
  ++looking_;
  changed_.wait_for(lock, most, [&] { return closed_ || (news_ && news_->number > number); });
  --looking_;
  looked_at_ = Clock::now();
  return news_ && news_->number > number && !closed_ ? news_ : nullptr;
}

bool Desk::closed() {
  const std::scoped_lock lock(mutex_);
  return closed_;
}

std::optional<Error> Desk::failed() {
  const std::scoped_lock lock(mutex_);
  return failed_;
}

void Desk::Run() {
  const auto served = Guarded("the console's link to the fleet", [this] { ServeUntilClosed(); });
  if (!served) {
    const std::scoped_lock lock(mutex_);
    failed_ = served.error();
  }
  Close();
  Begin();
  for (const auto& errand : errands_) {
    errand->GiveUp(served ? Error{ErrorCode::kUnavailable, "the console ends"} : served.error());
  }
}

void Desk::ServeUntilClosed() {
  while (!closed()) {
    Begin();
    Say(Clock::now());
    const std::vector<exchange::Message> heard = exchange_->Take(kTakeWait);
    const auto now = Clock::now();
    for (const exchange::Message& message : heard) Hear(message, now);
    SeeTo(now);
    ShowNews(now);
  }
}

// A stop is said before anything else.
void Desk::Begin() {
  std::deque<std::shared_ptr<Errand>> stops;
  std::deque<std::shared_ptr<Errand>> others;
  {
    const std::scoped_lock lock(mutex_);
    stops.swap(stops_);
    others.swap(others_);
  }
  const auto now = Clock::now();
  for (const auto* asked : {&stops, &others}) {
    for (const auto& errand : *asked) {
      errand->began = now;
      errand->Begin(state_, now);
    }
  }
  errands_.insert(errands_.begin(), stops.begin(), stops.end());
  errands_.insert(errands_.end(), others.begin(), others.end());
}

void Desk::Say(Clock::time_point now) {
  for (const exchange::DriveCommand& command : driving_.Take(self_)) {
    // What is lost is said anew, by whoever drives.
    if (state_.Teaches(command.agent)) (void)exchange_->Publish(command);
  }
  for (const exchange::NowCommand& stop : state_.TakeOpenStops(now)) {
    (void)exchange_->Publish(stop);  // said again until it is answered
  }
  for (const auto& errand : errands_) {
    if (now < errand->say_at) continue;
    errand->say_at = now + errand->SayAgain();
    for (const exchange::Message& word : errand->Words()) {
      // What could not be handed over is said again.
      (void)exchange_->Publish(word);
      if (const auto* mission = std::get_if<mission::Mission>(&word)) {
        state_.Sent(*mission, NowUnixMs());
      }
    }
  }
  const auto over = std::stable_partition(errands_.begin(), errands_.end(), [&](const auto& each) {
    return !each->IsOver(std::chrono::duration_cast<milliseconds>(now - each->began));
  });
  const std::vector<std::shared_ptr<Errand>> done(over, errands_.end());
  errands_.erase(over, errands_.end());
  {
    const std::scoped_lock lock(mutex_);
    for (const auto& errand : done) under_way_ -= errand->counts ? 1 : 0;
  }
  for (const auto& errand : done) errand->End(state_);
  // Who has its answer has room for the next question.
  for (const auto& errand : done) errand->Finish();
}

void Desk::Hear(const exchange::Message& message, Clock::time_point now) {
  state_.Handle(message, now, NowUnixMs());
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message))
    driving_.Note(*status, now);
  for (const auto& errand : errands_) errand->Hear(message);
}

bool Desk::SomebodyLooks(Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  const bool has_looked = looked_at_ != Clock::time_point{};
  return looking_ > 0 || (has_looked && now < looked_at_ + options_.looks_on);
}

// What is lost is asked for the next time.
void Desk::AskServers(Clock::time_point now) {
  if (now < ask_at_) return;
  asked_at_ = now;
  ask_at_ = now + options_.ask_every;
  mission::Query latest;
  latest.page_size = static_cast<std::uint32_t>(FleetState::kMissionsShown);
  const std::uint64_t request = fleet::DrawNumber();
  state_.AskedForMissions(request);
  (void)exchange_->Publish(
      exchange::MissionRequest{.client = self_, .request = request, .query = latest});
}

// Whether somebody looks or not.
void Desk::SeeTo(Clock::time_point now) {
  if (now >= see_to_at_) {
    state_.Tick(now);
    NoteAlerts(now);
  }
  if (alerts_.changes() == alerts_kept_) return;
  alerts_kept_ = alerts_.changes();
  if (options_.keep_alerts) options_.keep_alerts(alerts_.Text());
}

void Desk::NoteAlerts(Clock::time_point now) {
  see_to_at_ = now + kSeeToEvery;
  const auto [causes, subjects, unsure] = state_.WhatToSeeTo(alerts_);
  alerts_.Note(causes, subjects, unsure, NowUnixMs());
  for (const AgentId& gone : state_.TakeGone()) (void)alerts_.End(gone.value(), NowUnixMs());
}

void Desk::ShowNews(Clock::time_point now) {
  if (now < show_at_) return;
  if (!SomebodyLooks(now)) {
    const std::scoped_lock lock(mutex_);
    news_.reset();
    return;
  }
  show_at_ = now + kNewsEvery;
  state_.Tick(now);
  NoteAlerts(now);  // so that they are about what is shown
  if (state_.lacks_missions()) ask_at_ = std::min(ask_at_, asked_at_ + kAskAgain);
  AskServers(now);
  for (const RouteId& route : state_.TakeLackingRoutes(now)) {
    route::RouteQuery revisions;
    revisions.name = route.value();
    revisions.page_size = kRevisionsAsked;
    (void)exchange_->Publish(exchange::CatalogRequest{self_, fleet::DrawNumber(), revisions});
  }
  program::Json shown = state_.Shown();
  shown["alerts"] = alerts_.OpenShown();
  auto state = std::make_shared<const program::Json>(std::move(shown));
  {
    const std::scoped_lock lock(mutex_);
    if (news_ && *news_->state == *state) return;
    news_ = std::make_shared<const News>(News{++news_count_, std::move(state)});
  }
  changed_.notify_all();
}

}  // namespace trailcast::console
