#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/base/newest_map.h"
#include "services/exchange/route_exchange.h"

namespace trailcast::agent {

// One membership of the network for an agent that follows many routes, one after the other. Each
// route is a visit, which at first hears what a late joiner would hear.
class LastingExchange {
 public:
  // Strangers can make up routes and names, so no more samples are remembered.
  static constexpr std::size_t kMostRemembered = 20'000;

  explicit LastingExchange(std::unique_ptr<exchange::RouteExchange> exchange)
      : exchange_(std::move(exchange)) {}

  // The agent itself, which continues through all visits. The thread that takes messages calls
  // `hear` for each message, then `say`, which may publish, and `saw_status` for each status that a
  // visit publishes.
  struct Tending {
    std::function<void(const exchange::Message&)> hear;
    std::function<void(exchange::RouteExchange&)> say;
    std::function<void(const exchange::AgentStatus&)> saw_status;
  };
  void Tend(Tending tending) { tending_ = std::move(tending); }

  // Returns everything heard while there is no visit.
  [[nodiscard]] std::vector<exchange::Message> Take(std::chrono::milliseconds max_wait);
  [[nodiscard]] exchange::RouteExchange& exchange() { return *exchange_; }

  // Begins a visit. There is one at a time, and this object must outlive it.
  [[nodiscard]] std::unique_ptr<exchange::RouteExchange> Visit();

 private:
  class Visitor;
  [[nodiscard]] std::vector<exchange::Message> Remembered() const;
  void Remember(const exchange::Message& message);

  std::unique_ptr<exchange::RouteExchange> exchange_;
  Tending tending_;
  // The last sample of each instance (exchange::InstanceOf).
  NewestMap<std::string, exchange::Message> remembered_{kMostRemembered};
};

}  // namespace trailcast::agent
