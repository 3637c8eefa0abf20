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

// A sign of life for whoever watches a process, as a container's health check does: a file, renewed
// every second as long as the loop runs that takes from the exchange, with the process's own latest
// status in it.

inline constexpr std::chrono::seconds kHeartbeatInterval{1};
inline constexpr std::chrono::seconds kHeartbeatStaleAfter{5};

// `exchange`, whose Take renews `file`. What keeps it off its `network` is told, too, and a server
// is not well then; null: nothing ever does.
[[nodiscard]] std::unique_ptr<exchange::RouteExchange> WithHeartbeat(
    std::unique_ptr<exchange::RouteExchange> exchange, std::filesystem::path file,
    std::shared_ptr<const exchange::NetworkState> network = nullptr);

// What the process does, in its own words. kNotFound without a file; kUnavailable when it was not
// renewed for `stale_after`, or says that the process cannot go on.
[[nodiscard]] Result<std::string> ReadHeartbeat(
    const std::filesystem::path& file,
    std::chrono::milliseconds stale_after = kHeartbeatStaleAfter);

// The option --heartbeat and the command 'health', which needs no --store though `app` does.
CLI::App* AddHeartbeat(CLI::App& app, CommonOptions& options);
// Tells what the heartbeat of `options` says; the process's exit status.
int RunHealth(const CLI::App& app, const CommonOptions& options);

}  // namespace trailcast::program
