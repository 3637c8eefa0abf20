#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::bench {

// These are the subcommands of console_bench, with which console.sh measures.

// These make complete routes of one name each, 92 m long. Routes that robots follow (the first
// `followed`) have thirty segments that decode; all others have one.
[[nodiscard]] route::RouteInfo ConsoleRoute(std::uint32_t n, std::uint32_t followed);
[[nodiscard]] Result<void> MakeConsoleStore(const std::filesystem::path& file, std::uint32_t routes,
                                            std::uint32_t followed);

struct PlayedFleetOptions {
  std::uint32_t robots = 100;
  std::string network_interface = "eth0";
  bool still = false;  // they report the same all the time
};
// Plays robots on missions until a signal, each a member of the fleet. Each reports as often as in
// a fleet of this size, has come further each time, and takes the missions that it is sent.
[[nodiscard]] Result<void> PlayFleet(const PlayedFleetOptions& options);

struct ConsoleOptions {
  std::filesystem::path programs;
  std::filesystem::path folder;  // to work in
  std::string network_interface = "eth0";
  pid_t server = 0;
  std::uint32_t robots = 100;
  std::uint32_t routes = 5000;
  int seconds = 30;             // for each figure
  std::uint32_t day = 432'000;  // changes that the page receives; 0 if it is not left open
};
// Starts a console and a browser, and prints what they cost, and how smooth the pages are.
[[nodiscard]] Result<void> MeasureConsole(const ConsoleOptions& options);

}  // namespace trailcast::bench
