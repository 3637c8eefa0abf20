#pragma once

#include <cstdint>
#include <memory>
#include <random>

#include "services/exchange/route_exchange.h"

namespace trailcast::exchange {

// These are shares of received messages, each in 0..1 and decided independently.
struct Faults {
  double drop = 0.0;
  double duplicate = 0.0;
  double delay =
      0.0;  // held back for one to `max_delay_takes` calls of Take, so later ones overtake
  double corrupt = 0.0;  // share of the pieces, of each of which one byte is changed
  int max_delay_takes = 4;
};

// This is a bad network between its owner and a real exchange, for tests. Faults strike what is
// received, so that each receiver of a multicast has its own. It is deterministic for a seed.
class FaultyExchange : public RouteExchange {
 public:
  FaultyExchange(std::unique_ptr<RouteExchange> inner, Faults faults, std::uint32_t seed);

  void set_faults(const Faults& faults) { faults_ = faults; }
  // Out of radio range, what is published is lost without an error, and nothing is received.
  void set_cut_off(bool cut_off) { cut_off_ = cut_off; }
  // Publish then fails with kUnavailable, as for a writer that is blocked by a stalled reader.
  void set_refusing(bool refusing) { refusing_ = refusing; }

  [[nodiscard]] Result<void> Publish(const Message& message) override;
  [[nodiscard]] std::vector<Message> Take(std::chrono::milliseconds max_wait) override;
  [[nodiscard]] Result<void> Listen(exchange::Topic topic,
                                    const std::set<route::RouteKey>& routes) override {
    return inner_->Listen(topic, routes);
  }
  [[nodiscard]] std::uint64_t dropped() const override { return inner_->dropped(); }

 private:
  struct Delayed {
    int takes_left = 0;
    Message message;
  };

  [[nodiscard]] bool Strikes(double share);
  void CorruptSome(Message& message);

  std::unique_ptr<RouteExchange> inner_;
  Faults faults_;
  bool cut_off_ = false;
  bool refusing_ = false;
  std::vector<Delayed> delayed_;
  std::mt19937 random_;
};

}  // namespace trailcast::exchange
