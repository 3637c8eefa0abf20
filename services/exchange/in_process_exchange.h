#pragma once

#include <memory>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// The bus inside one process: what tests and lockstep simulations use in place of DDS, with the
// same semantics (bounds, batches split, latest per key for late joiners, AgentGone). Exchanges may
// live on different threads; each has one owner. The bus stays alive as long as one of its
// exchanges.
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
