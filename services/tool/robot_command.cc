#include <cstdio>
#include <memory>
#include <string>

#include "agent/device/device_options.h"
#include "agent/simulated/virtual_robot.h"
#include "services/program/stop_signal.h"
#include "services/tool/command.h"

namespace trailcast::tool {
namespace {

struct RobotOptions {
  agent::DeviceOptions device;  // its simulated part
  agent::VirtualRobotOptions robot;
  bool scout = false;
};

constexpr const char* kExamples =
    "Examples:\n"
    "  trailcast robot --sim indoor --scout --lockstep --ros2 /scout\n"
    "  trailcast-agent teach --ros2 /scout --lockstep --end-when-still 2 --route hall\n"
    "                        --store scout.db --server\n"
    "  trailcast robot --sim indoor --camera wide --seed 7 --ros2 /robot1 \\\n"
    "                  --fail camera-freezes@5      # and see its agent stop it\n"
    "It runs until a signal ends it, and then says what it heard from its agent.";

CLI::Validator FaultValidator() {
  return {[](std::string& text) {
            const auto fault = agent::ParseRobotFault(text);
            return fault ? std::string() : fault.error().message;
          },
          "FAULT@S"};
}

Result<void> Run(const program::CommonOptions& common, const RobotOptions& options) {
  const program::StopSignal stop;
  agent::SimulatedRun run = options.device.simulated;
  run.drives_itself = options.scout;
  run.stays_at_end = true;
  auto device = agent::SimulatedDevice::Open(run);
  if (!device) return tl::unexpected(device.error());
  agent::VirtualRobotOptions robot = options.robot;
  agent::JoinNetwork(robot.topics, common);
  robot.stop = [] { return program::StopSignal::requested(); };
  const auto summary = agent::RunVirtualRobot(**device, robot);
  if (!summary) return tl::unexpected(summary.error());
  std::fputs(summary->Text().c_str(), stdout);
  if (options.device.truth.empty()) return {};
  return (*device)->WriteTruth(options.device.truth);
}

}  // namespace

Command AddRobotCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<RobotOptions>();
  CLI::App* app = parent.add_subcommand(
      "robot", "A virtual robot that an agent drives as it would a real one, over ROS 2 topics");
  app->footer(kExamples);
  app->option_defaults()->always_capture_default();
  agent::AddSimulatedOptions(*app, options->device, true)->required();
  app->add_flag("--scout", options->scout,
                "Drives itself along the path, as if by an operator, and stands at its end");
  CLI::Option* ros2 = app->add_option("--ros2", options->robot.topics.robot,
                                      "Its namespace, as '/robot1', or '/' for none");
  ros2->required();
  agent::AddRos2TopicOptions(*app, ros2, "Topics", options->robot.topics);
  CLI::Option* lockstep = app->add_flag(
      "--lockstep", options->robot.lockstep,
      "Wait for the answer to each frame ('trailcast-agent ... --lockstep'), so that a slow "
      "machine changes nothing but the time it takes");
  app->add_option_function<std::string>(
         "--fail",
         [options](const std::string& text) {
           if (auto fault = agent::ParseRobotFault(text)) options->robot.fault = *fault;
         },
         "What goes wrong S seconds after it was first told to drive: camera-freezes, "
         "camera-stops, odometry-stops, base-stops")
      ->check(FaultValidator())
      ->excludes(lockstep);
  return {app, [app, options, &common] {
            program::SetUpLog(common);
            if (auto ran = Run(common, *options); !ran) return program::Complain(*app, ran.error());
            return program::kExitOk;
          }};
}

}  // namespace trailcast::tool
