#include <utility>
#include <vector>

#include "services/program/heap.h"
#include "services/tool/commands/command.h"

namespace {

constexpr const char* kMainExamples =
    "Examples:\n"
    "  trailcast demo                         # a scout teaches three robots with other cameras\n"
    "  trailcast trial --trials 10            # ten times teach and follow, measured\n"
    "  trailcast align drive1/ drive2/ --out truth.csv   # where drive2's frames were taken\n"
    "  trailcast judge drive1/ drive2/        # recordings taught and replayed, measured\n"
    "  trailcast explain run.mcap             # what happened in a replay, and why\n"
    "  trailcast routes                       # what the route server keeps\n"
    "  trailcast export hall                  # a route as a file, hall.trailcast\n"
    "  trailcast import hall.trailcast        # and to another route server\n"
    "  trailcast where --frame now.png        # which routes show this, and where on them\n"
    "  trailcast junctions --store server.db     # where routes come to the same place\n"
    "  trailcast fleet                        # robots that are heard, and how they are\n"
    "  trailcast send robot2 follow hall      # an available robot; see 'missions', too\n"
    "  trailcast schedule list                # missions at times: see its --help\n"
    "  trailcast network join hall@12 office@0   # routes become a network\n"
    "  trailcast send robot2 goto office@8    # the best way over it\n"
    "  trailcast snapshot robot2                # what its camera sees, as a picture\n"
    "  trailcast photos --place dock          # what robots photographed there on missions\n"
    "  trailcast pause robot2                 # and resume, cancel, stop, release: robots at work\n"
    "  trailcast keys init                    # who may take part, and as what: DDS Security\n"
    "  trailcast doctor                       # is this machine fit to share routes?\n"
    "  trailcast robot --sim indoor --ros2 /robot1   # a virtual robot for an agent\n"
    "Each subcommand has its own --help.";

int Run(int argc, char** argv) {
  using trailcast::tool::Command;
  CLI::App app("The operator's tool: show, measure and look up what robots teach each other",
               "trailcast");
  app.footer(kMainExamples);
  app.require_subcommand(1);
  app.fallthrough();
  trailcast::program::CommonOptions common;
  common.name = "operator";
  trailcast::program::AddCommonOptions(app, common);
  std::vector<Command> commands{trailcast::tool::AddDemoCommand(app, common),
                                trailcast::tool::AddTrialCommand(app),
                                trailcast::tool::AddAlignCommand(app),
                                trailcast::tool::AddJunctionsCommand(app),
                                trailcast::tool::AddJudgeCommand(app),
                                trailcast::tool::AddFiguresCommand(app),
                                trailcast::tool::AddExplainCommand(app),
                                trailcast::tool::AddRoutesCommand(app, common),
                                trailcast::tool::AddExportCommand(app, common),
                                trailcast::tool::AddImportCommand(app, common),
                                trailcast::tool::AddWhereCommand(app, common),
                                trailcast::tool::AddFleetCommand(app, common),
                                trailcast::tool::AddReachCommand(app, common),
                                trailcast::tool::AddSnapshotCommand(app, common),
                                trailcast::tool::AddPhotosCommand(app, common),
                                trailcast::tool::AddNetworkCommand(app, common),
                                trailcast::tool::AddKeysCommand(app),
                                trailcast::tool::AddDoctorCommand(app, common),
                                trailcast::tool::AddRobotCommand(app, common)};
  for (Command& command : trailcast::tool::AddMissionCommands(app, common)) {
    commands.push_back(std::move(command));
  }
  commands.push_back(trailcast::tool::AddScheduleCommand(app, common));
  for (Command& command : trailcast::tool::AddNowCommands(app, common)) {
    commands.push_back(std::move(command));
  }
  if (const auto ended = trailcast::program::Parse(app, argc, argv)) return *ended;
  trailcast::program::KeepFreedMemory();
  for (const Command& command : commands) {
    if (command.app->parsed()) return command.run();
  }
  return trailcast::program::kExitUsage;
}

}  // namespace

int main(int argc, char** argv) {
  return trailcast::program::RunMain("trailcast", [&] { return Run(argc, argv); });
}
