#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "services/network/network.h"

// This finds paths over a network of 10,000 routes of 10 to 200 m and 50,000 junctions, with one
// section in a hundred closed, from any place to any other. most_ms is the slowest, in processor
// time.

namespace trailcast::network {
namespace {

constexpr std::size_t kRoutes = 10'000;
constexpr std::size_t kJunctions = 50'000;
constexpr std::size_t kClosed = 100;

class Site {
 public:
  // `reach`: a junction leads to one of so many routes around; a site is wide, or all of it is
  // near.
  explicit Site(std::size_t reach) {
    for (std::size_t i = 0; i < kRoutes; ++i) {
      routes_.push_back({std::to_string(i), std::to_string(i), 10.0 + Share() * 190.0});
    }
    for (std::size_t i = 0; i < kJunctions; ++i) {
      const std::size_t from = random_() % kRoutes;
      const std::size_t to = (from + 1 + random_() % reach) % kRoutes;
      junctions_.push_back({.from = On(from), .to = On(to), .both = true});
    }
    for (std::size_t i = 0; i < kClosed; ++i) {
      const Place at = On(random_() % kRoutes);
      closed_.push_back(
          {.route = at.route, .from_m = at.along_m, .to_m = at.along_m + 5.0, .closed = true});
    }
  }
  [[nodiscard]] Network Made() const {
    auto made = Network::Build(routes_, junctions_, closed_);
    if (!made) {
      std::cerr << made.error().message << '\n';
      std::abort();
    }
    return *std::move(made);
  }
  [[nodiscard]] Place Anywhere() { return On(random_() % kRoutes); }

 private:
  [[nodiscard]] double Share() { return static_cast<double>(random_() % 1000) / 1000.0; }
  [[nodiscard]] Place On(std::size_t route) {
    return {routes_[route].id, routes_[route].length_m * Share()};
  }

  std::mt19937 random_{7};
  std::vector<Route> routes_;
  std::vector<Junction> junctions_;
  std::vector<Condition> closed_;
};

void ShortestWay(benchmark::State& state) {
  Site site(static_cast<std::size_t>(state.range(0)));
  const Network network = site.Made();
  double most_ms = 0.0;
  double found = 0.0;
  double sections = 0.0;
  for ([[maybe_unused]] auto _ : state) {
    const Place from = site.Anywhere();
    const Place to = site.Anywhere();
    const std::clock_t begin = std::clock();
    const auto way = network.ShortestWay(from, to);
    most_ms = std::max(most_ms, 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (!way) continue;
    found += 1.0;
    sections += static_cast<double>(way->sections.size());
  }
  state.counters["most_ms"] = most_ms;
  state.counters["found"] = found / static_cast<double>(state.iterations());
  state.counters["stretches"] = found > 0.0 ? sections / found : 0.0;
}
BENCHMARK(ShortestWay)
    ->ArgName("reach")
    ->Arg(20)
    ->Arg(static_cast<int>(kRoutes) - 1)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(300);

void Build(benchmark::State& state) {
  const Site site(kRoutes - 1);
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(site.Made());
}
BENCHMARK(Build)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trailcast::network

BENCHMARK_MAIN();
