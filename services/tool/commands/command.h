#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "services/program/command_line.h"

namespace trailcast::tool {

// This is a subcommand of `trailcast`: its flags, and what it does once they are parsed. `Run`
// returns the process's exit status.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

// Complains of wrong words as program::Complain does, and returns kExitUsage.
inline int ComplainOfUsage(const CLI::App& app, const Error& error) {
  (void)program::Complain(app, error);
  return program::kExitUsage;
}

// Each of these adds its flags to `parent`. `common` is filled before the command runs, and
// outlives it.
[[nodiscard]] Command AddAlignCommand(CLI::App& parent);
[[nodiscard]] Command AddDemoCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddDoctorCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddExportCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddFleetCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddReachCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddSnapshotCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddImportCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddJunctionsCommand(CLI::App& parent);
[[nodiscard]] Command AddJudgeCommand(CLI::App& parent);
[[nodiscard]] Command AddKeysCommand(CLI::App& parent);
// These are send and missions.
[[nodiscard]] std::vector<Command> AddMissionCommands(CLI::App& parent,
                                                      const program::CommonOptions& common);
[[nodiscard]] Command AddNetworkCommand(CLI::App& parent, const program::CommonOptions& common);
// These are pause, resume, cancel, stop and release.
[[nodiscard]] std::vector<Command> AddNowCommands(CLI::App& parent,
                                                  const program::CommonOptions& common);
[[nodiscard]] Command AddPhotosCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddRobotCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddScheduleCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddTrialCommand(CLI::App& parent);
[[nodiscard]] Command AddFiguresCommand(CLI::App& parent);
[[nodiscard]] Command AddExplainCommand(CLI::App& parent);
[[nodiscard]] Command AddRoutesCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddWhereCommand(CLI::App& parent, const program::CommonOptions& common);

}  // namespace trailcast::tool
