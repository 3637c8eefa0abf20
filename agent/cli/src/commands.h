#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/device_options.h"
#include "agent/duty/run_logs.h"
#include "agent/follow/follower.h"
#include "agent/session/look_around.h"
#include "agent/teach/scout.h"
#include "services/program/command_line.h"

namespace trailcast::agent {

// The options of all commands of trailcast-agent.
struct CommandOptions {
  program::CommonOptions common;
  std::string store_file;
  bool server = false;  // join the network
  std::filesystem::path report;
};

struct TeachCommand {
  DeviceOptions device;
  std::string route;
  std::vector<std::string> tags;
  std::optional<route::Place> place;
  bool review = false;
  std::string unfinished = "ask";
  double delivery_timeout_s = 30.0;
};

struct FetchCommand {
  std::string route;
  std::uint32_t revision = 0;  // 0 for the newest
  std::string scout;           // empty for anybody
  double wait_s = 30.0;
};

struct ReplayCommand {
  DeviceOptions device;
  std::string route;
  std::uint32_t revision = 0;  // 0 for the active one
  std::string scout;           // empty for anybody
  std::filesystem::path csv;
  DiagnosisOptions diagnosis;
  std::string method = "default";
  double wait_s = 30.0;
  bool wait_for_route = false;
  double speed_factor = 1.0;
  bool backwards = false;
  bool from_start = false;
  std::string start = "left";
  double look_around_deg = kUsualLookAround_deg;
  double keep_distance_m = KeepDistanceOptions{}.distance_m;
  std::optional<double> max_slope_deg;
  std::string max_roughness;  // empty for any
  bool comfort = false;
  std::string refresh = "off";
};

struct ServeCommand {
  ReplayCommand replay;  // how it follows on missions
  RunLogsOptions logs;
  double logs_mb = 500.0;
  std::string photos;  // folder; empty for one beside the store
  double photos_mb = 500.0;
};

// Add the flags of the program and of its commands, which fill the structs.
void AddSharedOptions(CLI::App& app, CommandOptions& options);
void AddTeachOptions(CLI::App& command, TeachCommand& teach);
void AddReplayOptions(CLI::App& command, ReplayCommand& replay);
void AddServeOptions(CLI::App& command, ServeCommand& serve);
void AddFetchOptions(CLI::App& command, FetchCommand& fetch);
void AddDeliverOptions(CLI::App& command, TeachCommand& deliver);

// Each runs one command to its end and returns the process's exit status; an error is one, too.
[[nodiscard]] Result<int> RunTeach(const CommandOptions& options, const TeachCommand& teach);
[[nodiscard]] Result<int> RunReplay(const CommandOptions& options, const ReplayCommand& replay);
[[nodiscard]] Result<int> RunServe(const CommandOptions& options, const ServeCommand& serve);
[[nodiscard]] Result<int> RunFetch(const CommandOptions& options, const FetchCommand& fetch);
[[nodiscard]] Result<int> RunDeliver(const CommandOptions& options, const TeachCommand& deliver);
[[nodiscard]] Result<int> RunTeachings(const CommandOptions& options);

}  // namespace trailcast::agent
