#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tests/soak/cycle.h"
#include "tests/soak/faults.h"
#include "tests/soak/vitals.h"

namespace trailcast::soak {

// This adds up what was observed.
struct Report {
  std::uint64_t seed = 0;
  std::chrono::duration<double> took{};
  int cycles = 0;
  int casualties = 0;
  std::size_t segments = 0;
  int arrived = 0;
  std::vector<std::string> explained;
  std::vector<Faults::Recovery> recoveries;
  std::size_t receipted = 0;
  std::size_t checked = 0;
  int store_checks = 0;
  std::vector<Vitals> server;  // each second of one server process, once it is warm
  std::vector<std::string> failures;

  void Add(const Cycle::Outcome& outcome);
  [[nodiscard]] std::string Text() const;
};

}  // namespace trailcast::soak
