// This file has what other threads ask of a desk.
#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/unix_time.h"
#include "services/console/desk.h"
#include "services/console/src/api/errand.h"
#include "services/console/src/api/look_errand.h"
#include "services/fleet/draw.h"
#include "services/fleet/known_robot.h"
#include "services/fleet/sending.h"
#include "services/fleet/telling.h"
#include "services/mission/address.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using std::chrono::milliseconds;

// Questions are repeated more slowly, because their answers may be long.
constexpr milliseconds kAskErrandAgain{500};
// Servers that have not answered by then, while others have, are not waited for.
constexpr milliseconds kOthersAnswerWithin{1000};
// Beyond an errand's own time, this shows that the thread itself does not run.
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

class SendErrand final : public ErrandFor<std::vector<mission::Report>> {
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
  [[nodiscard]] Result<std::vector<mission::Report>> Outcome() const override {
    return sending_.Outcome(timeout_);
  }

  fleet::SendingToAll sending_;
  milliseconds timeout_;
};

// This fetches a photo, and asks for the next piece as soon as one has come.
class PhotoErrand final : public ErrandFor<std::vector<std::uint8_t>> {
 public:
  // A photo of half a megabyte takes this long on a link of 50 kB/s.
  static constexpr milliseconds kTimeout{10'000};

  PhotoErrand(const AgentId& self, const fleet::KnownPhoto& known) : fetch_(self, known) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {fetch_.Asks()}; }
  [[nodiscard]] milliseconds SayAgain() const override { return kAskErrandAgain; }
  void Hear(const exchange::Message& message) override {
    if (fetch_.Hear(message)) say_at = {};
  }
  [[nodiscard]] bool IsOver(milliseconds since) const override {
    return fetch_.outcome().has_value() || since > kTimeout;
  }

 private:
  [[nodiscard]] Result<std::vector<std::uint8_t>> Outcome() const override {
    if (fetch_.outcome()) return *fetch_.outcome();
    return Fail(ErrorCode::kUnavailable, "the route server that keeps the photo does not answer");
  }

  fleet::PhotoFetch fetch_;
};

// This is a mission's first step: it finds whether there is such a robot.
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

// The desk's thread does this at once, with what belongs to it.
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

// This is a question to servers, which is over when the first has answered.
template <typename Request, typename Reply>
class Question final : public ErrandFor<Reply> {
 public:
  // `wrong` is the error when a server refuses.
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

// This is a question to all servers, which is over when those that are heard have answered.
class QuestionToAll final : public ErrandFor<Desk::AllAnswers> {
 public:
  QuestionToAll(exchange::NetworkRequest request, milliseconds timeout)
      : request_(std::move(request)), timeout_(timeout) {}

  [[nodiscard]] std::vector<exchange::Message> Words() const override { return {request_}; }
  [[nodiscard]] milliseconds SayAgain() const override { return kAskErrandAgain; }
  void Begin(FleetState& state, std::chrono::steady_clock::time_point now) override {
    state.Tick(now);
    servers_ = state.ServersHeard();
  }
  void Hear(const exchange::Message& message) override {
    const auto* reply = std::get_if<exchange::NetworkReply>(&message);
    if (reply == nullptr || reply->client != request_.client) return;
    if (reply->request == request_.request) replies_.try_emplace(reply->server, *reply);
  }
  [[nodiscard]] bool IsOver(milliseconds since) const override {
    if (!servers_.empty() && Silent().empty()) return true;
    return since > (replies_.empty() ? timeout_ : kOthersAnswerWithin);
  }

 private:
  [[nodiscard]] std::vector<AgentId> Silent() const {
    std::vector<AgentId> silent = servers_;
    std::erase_if(silent, [&](const AgentId& server) { return replies_.contains(server); });
    return silent;
  }
  [[nodiscard]] Result<Desk::AllAnswers> Outcome() const override {
    if (replies_.empty()) return Fail(ErrorCode::kUnavailable, "no route server answers");
    Desk::AllAnswers answers{.silent = Silent()};
    for (const auto& [server, reply] : replies_) {
      if (reply.error.empty()) answers.replies.push_back(reply);
    }
    if (!answers.replies.empty()) return answers;
    const auto& [server, reply] = *replies_.begin();
    return Fail(ErrorCode::kConflict, "server '{}': {}", server.value(), reply.error);
  }

  exchange::NetworkRequest request_;
  milliseconds timeout_;
  std::vector<AgentId> servers_;
  std::map<AgentId, exchange::NetworkReply> replies_;
};

// This reads the desk's own state, in its thread.
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

// Waits for a result, by a `future` that may be shared.
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

// A server may have heard of a robot that this console has not.
std::optional<Error> Desk::Unknown(const AgentId& robot) {
  auto unknown = CarryOut(std::make_shared<WhoErrand>(robot), false, milliseconds(0));
  if (!unknown || !*unknown) return std::nullopt;
  mission::Query of_robot;
  of_robot.agent = robot.value();
  const auto missions = Missions(of_robot);
  if (!missions || fleet::HasHeardOf(*missions, robot.value())) return std::nullopt;
  return *std::move(*unknown);
}

Result<std::vector<mission::Report>> Desk::Send(mission::Mission mission, bool also_unheard) {
  const auto addressed = mission::ParseAddress(mission.agent.value());
  if (!addressed) return tl::unexpected(addressed.error());
  for (const std::string& each : also_unheard ? std::vector<std::string>{} : *addressed) {
    if (auto unknown = Unknown(AgentId(each))) return tl::unexpected(*std::move(unknown));
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
            // A robot that was not heard since the console started may still have alerts from
            // before.
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

Result<Desk::AllAnswers> Desk::AskAll(const std::string& words, std::uint32_t first) {
  const exchange::NetworkRequest request{self_, fleet::DrawNumber(), words, first};
  return CarryOut(std::make_shared<QuestionToAll>(request, options_.reply_within), false,
                  options_.reply_within);
}

Result<exchange::NetworkReply> Desk::Join(const std::string& words) {
  const exchange::NetworkEdit edit{self_, fleet::DrawNumber(), words};
  return CarryOut(
      std::make_shared<NetworkChange>(edit, options_.reply_within, ErrorCode::kConflict), false,
      options_.reply_within);
}

Result<std::vector<std::uint8_t>> Desk::Photo(const fleet::KnownPhoto& known) {
  return CarryOut(std::make_shared<PhotoErrand>(self_, known), false, PhotoErrand::kTimeout);
}

Result<http::MetricsText> Desk::Measure() {
  auto text = CarryOut(std::make_shared<MeasureErrand>(state_), false, milliseconds(0));
  if (!text) return text;
  const std::scoped_lock lock(mutex_);
  text->Add("console_requests_refused_total", "counter",
            "Commands and questions that were one too many.", refused_);
  if (options_.measure) options_.measure(*text);
  return text;
}

Result<std::shared_ptr<const exchange::Snapshot>> Desk::Look(const AgentId& robot) {
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

}  // namespace trailcast::console
