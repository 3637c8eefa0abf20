// This part of FollowerLink tells others about this follower, and hears about them.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/link/follower_link.h"
#include "services/base/time.h"
#include "services/base/unix_time.h"
#include "services/exchange/publish.h"

namespace trailcast::agent {
namespace {

exchange::AgentMode ModeOf(ReplayState state) {
  switch (state) {
    case ReplayState::kWaiting:
    case ReplayState::kYielding:
    case ReplayState::kHeld:
      return exchange::AgentMode::kWaiting;
    case ReplayState::kFollowing:
    case ReplayState::kBlind:
      return exchange::AgentMode::kReplaying;
    case ReplayState::kArrived:
      return exchange::AgentMode::kArrived;
    case ReplayState::kLost:
      return exchange::AgentMode::kFault;
  }
  return exchange::AgentMode::kFault;
}

exchange::CarriedBy CarriedBy(Evidence evidence) {
  switch (evidence) {
    case Evidence::kNothing:
      return exchange::CarriedBy::kNothing;
    case Evidence::kFeatures:
      return exchange::CarriedBy::kFeatures;
    case Evidence::kViews:
      return exchange::CarriedBy::kViews;
    case Evidence::kMotion:
      return exchange::CarriedBy::kMotion;
  }
  return exchange::CarriedBy::kNothing;
}

exchange::Following FollowingOf(const ReplayStep& step) {
  exchange::Following following{CarriedBy(step.evidence), std::nullopt};
  if (step.odometry) {
    const double percent = std::round(100.0 * std::clamp(step.odometry->trust, 0.0, 1.0));
    following.odometry = exchange::OdometryTrust{static_cast<std::uint8_t>(percent),
                                                 step.odometry->scale.value_or(0.0)};
  }
  return following;
}

}  // namespace

void FollowerLink::Close(exchange::AgentMode mode, const std::string& detail) {
  TakeReports();
  EndNote(mode);
  if (!presence_) return;
  if (presence_->server()) followed_note_.Tell(*exchange_);
  ShowStatus();
  exchange::AgentStatus status = presence_->status();
  status.mode = mode;
  status.detail = detail;
  status.speed_mps = 0.0;
  presence_->Set(std::move(status));
  presence_->Publish();
}

void FollowerLink::ShowStatus() {
  exchange::AgentStatus status;
  status.route = route_ ? route_->name : options_.route;
  status.segments = route_ ? route_->segment_count : 0;
  const bool started = next_feed_ > 0 || latest_.state != ReplayState::kWaiting;
  status.mode = started ? ModeOf(latest_.state) : exchange::AgentMode::kWaiting;
  status.segment = latest_.segment.value();
  status.progress = latest_.progress;
  status.speed_mps = latest_.command.linear_mps;
  status.features = static_cast<std::uint32_t>(std::max(0, latest_.features));
  status.found_share = latest_.found_share;
  status.detail = started && latest_.state != ReplayState::kWaiting ? latest_.reason : waiting_for_;
  if (!latest_.robot_waits_for.empty()) {
    status.mode = exchange::AgentMode::kWaiting;
    status.detail = latest_.robot_waits_for;
  }
  if (!latest_.robot_trouble.empty()) {
    status.mode = exchange::AgentMode::kFault;
    status.detail = latest_.robot_trouble;
  }
  status.held = held_revisions_;
  if (route_ && latest_.along_m) {
    const auto offset = latest_.decision.offset.value_or(replay::PathOffset{});
    status.place = {route_->key, *latest_.along_m, offset.left_m, offset.left_sigma_m};
  }
  if (status.mode == exchange::AgentMode::kReplaying) status.following = FollowingOf(latest_);
  status.hold = now_handler_.shown_hold();
  status.on_duty = options_.now_handler != nullptr;
  presence_->Set(std::move(status));
}

void FollowerLink::HearOperators(const exchange::Message& message) {
  if (!options_.hears_operators) return;
  now_handler_.Handle(message, route_ ? route_->name : options_.route, NowUnixMs());
  for (const std::string& line : now_handler_.TakeNews()) spdlog::warn("{}", line);
}

void FollowerLink::AnswerOperators() {
  // A command whose answer is not sent now comes again.
  (void)exchange::PublishAll(*exchange_, now_handler_.TakeAnswers());
}

bool FollowerLink::TellHold() {
  if (now_handler_.hold() == hold_told_) return true;
  Hold hold = now_handler_.hold();
  if (!told_hold_.TryPut(std::move(hold))) return false;
  hold_told_ = now_handler_.hold();
  fed_.Ring();
  return true;
}

void FollowerLink::HearServer() {
  const auto& server = presence_->server();
  if (server == told_server_) return;
  if (server) {
    spdlog::info("server '{}' is there", server->value());
  } else {
    spdlog::warn("server '{}' is gone: going on with what is in {}", told_server_->value(),
                 options_.store_file);
  }
  told_server_ = server;
}

void FollowerLink::TellNeighbours(Time now) {
  if (!route_) return;
  for (const Neighbour& gone : neighbours_.Forget(now)) {
    spdlog::warn(
        "{} was last heard {:.0f} s ago, {:.1f} m along the route, and may still stand there: no "
        "longer waiting for it",
        gone.agent.value(), Seconds(now - gone.told_at), gone.along_m);
  }
  auto on = neighbours_.On(route_->key);
  if (on == told_) return;
  auto copy = on;
  // If the queue is full, the control loop works on a frame and will get newer ones.
  if (!told_neighbours_.TryPut(std::move(copy))) return;
  told_ = std::move(on);
  fed_.Ring();
}

}  // namespace trailcast::agent
