#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "services/exchange/route_exchange.h"
#include "tests/soak/casualties.h"
#include "tests/soak/cycle.h"
#include "tests/soak/faults.h"
#include "tests/soak/fleet.h"
#include "tests/soak/ledger.h"
#include "tests/soak/private_disk.h"
#include "tests/soak/report.h"

namespace trailcast::soak {

struct SoakOptions {
  std::chrono::minutes length{120};
  std::uint64_t seed = 1;
  std::filesystem::path folder;  // logs and stores
  std::filesystem::path csv;     // the server's vitals, one line a second; empty if not written
};

// This teaches, follows and retires repeatedly, while things go wrong. In the first half of the
// time the server is killed like all other members. In the second half it lives on, so that its
// memory can be judged.
class Soak {
 public:
  explicit Soak(const SoakOptions& options);
  // Runs until the time is over and the cycle that runs then has ended, or until `stop`.
  [[nodiscard]] Report Run(const std::function<bool()>& stop);

 private:
  void RunCycle(int number, const std::function<bool()>& stop);
  void Hear(Clock::time_point now);
  void CalmDown();
  void CheckStore();
  void SampleServer(Clock::time_point now);
  void TellCycle(const Cycle::Outcome& outcome);
  void End();

  SoakOptions options_;
  PrivateDisk disk_;
  test::NetworkLab lab_;
  Fleet fleet_;
  Faults faults_;
  Casualties casualties_;
  Ledger ledger_;
  std::unique_ptr<exchange::RouteExchange> exchange_;
  std::vector<Retired> live_;
  Clock::time_point sample_at_{};
  std::vector<Vitals> sampled_;  // each second of the server that is no longer killed
  Report report_;
  Clock::time_point began_ = Clock::now();
  Cycle* cycle_ = nullptr;  // the present cycle
};

}  // namespace trailcast::soak
