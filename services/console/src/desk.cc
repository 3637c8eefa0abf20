#include "services/console/desk.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "services/base/guarded.h"
#include "services/base/unix_time.h"
#include "services/console/src/api/errand.h"
#include "services/fleet/draw.h"
#include "services/program/json.h"

namespace trailcast::console {
namespace {

using exchange::Topic;
using std::chrono::milliseconds;

// An errand waits for the thread for this long at most.
constexpr milliseconds kTakeWait{10};
// Servers are asked again so soon about missions that were just heard of.
constexpr milliseconds kAskAgain{1000};
// So many revisions of a robot's route are asked for.
constexpr std::uint32_t kRevisionsAsked = 100;

}  // namespace

exchange::TopicUse ConsoleTopics() {
  return {.write = {Topic::kNow, Topic::kMissions, Topic::kMissionRequests, Topic::kCatalogRequests,
                    Topic::kRouteEdits, Topic::kDrives, Topic::kSnapshotRequests,
                    Topic::kNetworkEdits, Topic::kNetworkRequests, Topic::kPhotoRequests},
          .read = {Topic::kSnapshots, Topic::kPhotos, Topic::kNowAnswers, Topic::kMissionStates,
                   Topic::kMissionReplies, Topic::kCatalogReplies, Topic::kNetworkReplies},
          // These are repeated all the time, and acknowledging each would cost the radio as much
          // again.
          .overhear = {Topic::kAgents}};
}

exchange::TopicUse LookingTopics() {
  return {.write = {Topic::kMissionRequests, Topic::kCatalogRequests, Topic::kSnapshotRequests,
                    Topic::kNetworkRequests, Topic::kPhotoRequests},
          .read = {Topic::kMissionReplies, Topic::kCatalogReplies, Topic::kSnapshots,
                   Topic::kPhotos, Topic::kNetworkReplies},
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

// A stop is sent before anything else.
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
    // A lost command needs no repetition, because the driver sends the next.
    if (state_.Teaches(command.agent)) (void)exchange_->Publish(command);
  }
  for (const exchange::NowCommand& stop : state_.TakeOpenStops(now)) {
    (void)exchange_->Publish(stop);  // repeated until it is answered
  }
  for (const auto& errand : errands_) {
    if (now < errand->say_at) continue;
    errand->say_at = now + errand->SayAgain();
    for (const exchange::Message& word : errand->Words()) {
      // A message that could not be sent is repeated.
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
  // The errand no longer counts before its caller gets the answer, so that the caller's next
  // question has room.
  for (const auto& errand : done) errand->Finish();
}

void Desk::Hear(const exchange::Message& message, Clock::time_point now) {
  state_.Handle(message, now, NowUnixMs());
  if (const auto* status = std::get_if<exchange::AgentStatus>(&message)) {
    driving_.Note(*status, options_.driving_clock());
  }
  for (const auto& errand : errands_) errand->Hear(message);
}

bool Desk::SomebodyLooks(Clock::time_point now) {
  const std::scoped_lock lock(mutex_);
  const bool has_looked = looked_at_ != Clock::time_point{};
  return looking_ > 0 || (has_looked && now < looked_at_ + options_.looks_on);
}

// A lost reply is asked for the next time.
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

// This runs whether or not a page is open.
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
  if (options_.look) options_.look(alerts_.AllShown(), state_.MissionsShown());
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
  NoteAlerts(now);  // so that alerts match the state that is shown
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
