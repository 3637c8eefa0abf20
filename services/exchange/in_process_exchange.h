#pragma once

#include <memory>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// This is a bus inside one process, which tests and lockstep simulations use in place of DDS. Its
// semantics are the same: bounds, split batches, the latest sample per key for late joiners, and
// AgentGone. Exchanges may live on different threads; each has one owner. The bus lives as long as
// one of its exchanges.
class InProcessBus {
 public:
  InProcessBus();
  ~InProcessBus();
  InProcessBus(const InProcessBus&) = delete;
  InProcessBus& operator=(const InProcessBus&) = delete;

  [[nodiscard]] std::unique_ptr<RouteExchange> Open(const TopicUse& use);

  struct State;  // shared with the exchanges

 private:
  std::shared_ptr<State> state_;
};

}  // namespace trailcast::exchange
