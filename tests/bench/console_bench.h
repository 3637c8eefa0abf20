#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::bench {

// What console.sh measures with, each a subcommand of console_bench.

// Complete routes of one name each, 92 m long in thirty segments that decode where robots follow
// them (the first `followed`), and otherwise of one.
[[nodiscard]] route::RouteInfo ConsoleRoute(std::uint32_t n, std::uint32_t followed);
[[nodiscard]] Result<void> MakeConsoleStore(const std::filesystem::path& file, std::uint32_t routes,
                                            std::uint32_t followed);

struct PlayedFleetOptions {
  std::uint32_t robots = 100;
  std::string network_interface = "eth0";
  bool still = false;  // they tell the same again and again
};
// Until a signal: robots on duty on their ways, a member of the fleet each. Each says how it is as
// often as in a fleet of this size, has come further each time, and takes what missions it is sent.
[[nodiscard]] Result<void> PlayFleet(const PlayedFleetOptions& options);

struct ConsoleOptions {
  std::filesystem::path programs;
  std::filesystem::path folder;  // to work in
  std::string network_interface = "eth0";
  pid_t server = 0;
  std::uint32_t robots = 100;
  std::uint32_t routes = 5000;
  int seconds = 30;             // for each figure
  std::uint32_t day = 432'000;  // changes that the page is told; 0: it is not left open
};
// Starts a console and a browser, and prints what they cost, and how smooth the pages are.
[[nodiscard]] Result<void> MeasureConsole(const ConsoleOptions& options);

}  // namespace trailcast::bench
