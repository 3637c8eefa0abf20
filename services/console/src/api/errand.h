#pragma once

#include <chrono>
#include <future>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/console/fleet_state.h"
#include "services/exchange/messages.h"

namespace trailcast::console {

// Something that is asked of others: said again and again until it is over. All but the future
// belongs to the desk's thread.
class Errand {
 public:
  Errand() = default;
  virtual ~Errand() = default;
  Errand(const Errand&) = delete;
  Errand& operator=(const Errand&) = delete;

  [[nodiscard]] virtual std::vector<exchange::Message> Words() const = 0;
  [[nodiscard]] virtual std::chrono::milliseconds SayAgain() const {
    return std::chrono::milliseconds(200);
  }
  virtual void Hear(const exchange::Message& message) = 0;
  // Before its first words, and after its last: what the desk knows of the fleet.
  virtual void Begin(FleetState& /*state*/, std::chrono::steady_clock::time_point /*now*/) {}
  virtual void End(FleetState& /*state*/) {}
  // It has what it was after, or waits no longer.
  [[nodiscard]] virtual bool IsOver(std::chrono::milliseconds since) const = 0;
  virtual void Finish() = 0;
  virtual void GiveUp(const Error& error) = 0;

  // The desk's notes.
  using Time = std::chrono::steady_clock::time_point;
  Time began{};
  Time say_at{};
  bool counts = false;  // among those of which only so many are under way
};

// One that brings back a `Reply`.
template <typename Reply>
class ErrandFor : public Errand {
 public:
  [[nodiscard]] std::future<Result<Reply>> Future() { return promise_.get_future(); }
  void Finish() final { promise_.set_value(Outcome()); }
  void GiveUp(const Error& error) final { promise_.set_value(tl::unexpected(error)); }

 protected:
  [[nodiscard]] virtual Result<Reply> Outcome() const = 0;

 private:
  std::promise<Result<Reply>> promise_;
};

}  // namespace trailcast::console
