#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/exchange/route_exchange.h"
#include "tests/soak/audit.h"
#include "tests/soak/fleet.h"
#include "tests/soak/ledger.h"
#include "tests/support/process.h"

namespace trailcast::soak {

// These are routes of earlier cycles, which live on for a while.
struct Retired {
  std::string name;
  route::RouteKey key;
};

// This teaches and follows one route at once, and then audits it. It retires the route of the cycle
// before, and deletes the one before that.
class Cycle {
 public:
  struct Outcome {
    std::size_t segments = 0;
    int arrived = 0;
    std::vector<std::string> explained;  // why a follower did not arrive, in its own words
    std::vector<std::string> failures;
  };

  // All arguments outlive the cycle. `live` is newest first, and has this cycle's route afterwards.
  Cycle(const Errand& errand, Fleet& fleet, Ledger& ledger, exchange::RouteExchange& exchange,
        std::vector<Retired>& live);

  void Handle(const exchange::Message& message, Clock::time_point now);
  void Tick(Clock::time_point now);
  [[nodiscard]] bool done() const { return stage_ == Stage::kDone; }
  [[nodiscard]] const Outcome& outcome() const { return outcome_; }

 private:
  enum class Stage { kDriving, kAuditing, kRetiring, kDeleting, kDone };

  void Go(Stage stage, Clock::time_point now);
  void Fail(const std::string& what);
  void WatchRobots(Clock::time_point now);
  void NoteEnd(const Member& follower, int status);
  void ReadTaught(Clock::time_point now);
  void WatchAudit(Clock::time_point now);
  // Runs the operator's tool until it succeeds.
  void Operate(const std::vector<std::string>& words, Stage next, Clock::time_point now);

  Errand errand_;
  Fleet& fleet_;
  Ledger& ledger_;
  exchange::RouteExchange& exchange_;
  std::vector<Retired>& live_;
  Stage stage_ = Stage::kDriving;
  Clock::time_point deadline_;
  int robots_left_;
  std::optional<Audit> audit_;
  std::unique_ptr<test::Process> tool_;
  int tool_runs_ = 0;
  Outcome outcome_;
};

}  // namespace trailcast::soak
