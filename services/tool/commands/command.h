#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

#include "services/program/command_line.h"

namespace trailcast::tool {

// A subcommand of `trailcast`: what its flags are, and what it does once they are parsed. `Run`
// returns the process's exit status.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

// As program::Complain, of words that were typed wrongly; returns kExitUsage.
inline int ComplainOfUsage(const CLI::App& app, const Error& error) {
  (void)program::Complain(app, error);
  return program::kExitUsage;
}

// Each adds its flags to `parent`. `common` is filled by the time the command runs, and outlives
// it.
[[nodiscard]] Command AddAlignCommand(CLI::App& parent);
[[nodiscard]] Command AddDemoCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddDoctorCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddExportCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddFleetCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddReachCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddGlanceCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddImportCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddJointsCommand(CLI::App& parent);
[[nodiscard]] Command AddJudgeCommand(CLI::App& parent);
[[nodiscard]] Command AddKeysCommand(CLI::App& parent);
// send, missions.
[[nodiscard]] std::vector<Command> AddMissionCommands(CLI::App& parent,
                                                      const program::CommonOptions& common);
[[nodiscard]] Command AddNetworkCommand(CLI::App& parent, const program::CommonOptions& common);
// pause, resume, cancel, stop, release.
[[nodiscard]] std::vector<Command> AddNowCommands(CLI::App& parent,
                                                  const program::CommonOptions& common);
[[nodiscard]] Command AddRobotCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddTrialCommand(CLI::App& parent);
[[nodiscard]] Command AddFiguresCommand(CLI::App& parent);
[[nodiscard]] Command AddExplainCommand(CLI::App& parent);
[[nodiscard]] Command AddRoutesCommand(CLI::App& parent, const program::CommonOptions& common);
[[nodiscard]] Command AddWhereCommand(CLI::App& parent, const program::CommonOptions& common);

}  // namespace trailcast::tool
