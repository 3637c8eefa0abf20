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

// This is something that is asked of others repeatedly until it is over. All but the future belongs
// to the desk's thread.
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
  // The desk calls these before its first messages and after its last, with what it knows of the
  // fleet.
  virtual void Begin(FleetState& /*state*/, std::chrono::steady_clock::time_point /*now*/) {}
  virtual void End(FleetState& /*state*/) {}
  // Returns whether it has its answer, or waits no longer.
  [[nodiscard]] virtual bool IsOver(std::chrono::milliseconds since) const = 0;
  virtual void Finish() = 0;
  virtual void GiveUp(const Error& error) = 0;

  // These are the desk's notes.
  using Time = std::chrono::steady_clock::time_point;
  Time began{};
  Time say_at{};
  bool counts = false;  // counts towards the limit of those under way
};

// This is an errand that returns a `Reply`.
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
