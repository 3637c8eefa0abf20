#pragma once

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

#include "services/exchange/network_state.h"
#include "services/exchange/route_exchange.h"
#include "services/program/command_line.h"

namespace trailcast::program {

// A heartbeat for whoever watches a process, such as a container's health check: a file that is
// renewed every second as long as the loop that takes from the exchange runs, with the process's
// own latest status in it.

inline constexpr std::chrono::seconds kHeartbeatInterval{1};
inline constexpr std::chrono::seconds kHeartbeatStaleAfter{5};

// Returns `exchange`, whose Take then renews `file`. The file also tells what keeps the process off
// its `network`, which may be null; a server is not well then.
[[nodiscard]] std::unique_ptr<exchange::RouteExchange> WithHeartbeat(
    std::unique_ptr<exchange::RouteExchange> exchange, std::filesystem::path file,
    std::shared_ptr<const exchange::NetworkState> network = nullptr);

// Returns the process's activity in its own words. Errors: kNotFound without a file; kUnavailable
// if it was not renewed for `stale_after`, or says that the process cannot go on.
[[nodiscard]] Result<std::string> ReadHeartbeat(
    const std::filesystem::path& file,
    std::chrono::milliseconds stale_after = kHeartbeatStaleAfter);

// Adds the option --heartbeat and the command 'health', which needs no --store even if `app` does.
CLI::App* AddHeartbeat(CLI::App& app, CommonOptions& options);
// Prints what the heartbeat of `options` says, and returns the exit status.
int RunHealth(const CLI::App& app, const CommonOptions& options);

}  // namespace trailcast::program
