#include "services/fleet/mission_question.h"

#include <utility>

#include "services/fleet/draw.h"

namespace trailcast::fleet {
namespace {

constexpr std::chrono::milliseconds kAskServersAgain{500};

}  // namespace

MissionQuestion::MissionQuestion(exchange::MissionRequest request) : request_(std::move(request)) {
  request_.request = DrawNumber();
}

void MissionQuestion::Ask(exchange::RouteExchange& exchange, Time now) {
  if (now < ask_at_) return;
  ask_at_ = now + kAskServersAgain;
  (void)exchange.Publish(request_);
}

const exchange::MissionReply* MissionQuestion::AnswerIn(const exchange::Message& message) const {
  const auto* reply = std::get_if<exchange::MissionReply>(&message);
  if (reply == nullptr || reply->client != request_.client) return nullptr;
  return reply->request == request_.request && reply->error.empty() ? reply : nullptr;
}

}  // namespace trailcast::fleet
