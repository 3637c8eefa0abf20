#pragma once

#include <chrono>

#include "services/exchange/messages.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::fleet {

// A question about missions that is put to every server in reach while its owner does other things.
// It is repeated every half second for as long as the owner calls Ask, because a server may be
// found late. The request that is passed has no number yet.
class MissionQuestion {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit MissionQuestion(exchange::MissionRequest request);

  // Publishes the question if it is due.
  void Ask(exchange::RouteExchange& exchange, Time now);
  // Returns the reply if the message is one to this question that a server could give, else null.
  [[nodiscard]] const exchange::MissionReply* AnswerIn(const exchange::Message& message) const;

 private:
  exchange::MissionRequest request_;
  Time ask_at_{};
};

}  // namespace trailcast::fleet
