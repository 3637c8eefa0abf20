#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "agent/device/device_options.h"
#include "services/lab/simulated/virtual_robot.h"
#include "services/program/several.h"
#include "services/program/stop_signal.h"
#include "services/tool/commands/command.h"

namespace trailcast::tool {
namespace {

struct RobotOptions {
  agent::DeviceOptions device;  // its simulated part
  agent::VirtualRobotOptions robot;
  bool scout = false;
  double turn_radius_m = 0.0;
};

constexpr const char* kRobotExamples =
    "Examples:\n"
    "  trailcast robot --sim indoor --scout --lockstep --ros2 /scout\n"
    "  trailcast-agent teach --ros2 /scout --lockstep --end-when-still 2 --route hall\n"
    "                        --store scout.db --server\n"
    "  trailcast robot --sim indoor --camera wide --seed 7 --ros2 /robot1 \\\n"
    "                  --fail camera-freezes@5      # and see its agent stop it\n"
    "  trailcast robot --sim indoor --ros2 /robot1 --fail base-stops@4+3 --fail odometry-jumps@9\n"
    "  trailcast robot --sim indoor --ros2 /robot1 --obstacle 3,1.5,0.2@0+10\n"
    "                  # and see 'trailcast-agent replay --scan-topic scan' wait before it\n"
    "  trailcast robot --sim indoor --ros2 /scout --scout --rough 3,1.5,1,0.02\n"
    "                  # and see 'trailcast-agent teach --imu-topic imu' note it\n"
    "It runs until a signal ends it, and then says what it heard from its agent.";

void AddTimingOptions(CLI::App& app, CLI::Option* lockstep, agent::RobotTiming& timing) {
  const auto add = [&](const std::string& flag, double& value, const CLI::Validator& range,
                       const std::string& text) {
    app.add_option(flag, value, text)->check(range)->excludes(lockstep)->group("Timing");
  };
  add("--rate", timing.rate_hz, CLI::Range(1.0, 200.0), "Steps and odometry, a second");
  add("--picture-rate", timing.picture_rate_hz, CLI::Range(1.0, 200.0), "Pictures a second");
  add("--drop-pictures", timing.dropped, CLI::Range(0.0, 0.9), "Share of them that get lost");
  add("--picture-delay", timing.picture_delay_s, CLI::Range(0.0, 5.0),
      "Seconds from when one is taken until it is published");
  add("--base-delay", timing.base_delay_s, CLI::Range(0.0, 5.0),
      "Seconds from a command until the base obeys it");
  add("--stamps-late", timing.stamps_late_s, CLI::Range(-10.0, 10.0),
      "Seconds by which pictures' stamps are ahead of odometry's clock");
}

Result<void> Run(const program::CommonOptions& common, const RobotOptions& options) {
  const program::StopSignal stop;
  agent::SimulatedRun run = options.device.simulated;
  run.drives_itself = options.scout;
  run.stays_at_end = true;
  if (options.robot.timing.picture_rate_hz > options.robot.timing.rate_hz) {
    return Fail(ErrorCode::kInvalidArgument, "--picture-rate {:g} is above --rate {:g}",
                options.robot.timing.picture_rate_hz, options.robot.timing.rate_hz);
  }
  run.rate_hz = options.robot.timing.rate_hz;
  run.turn_radius_m = options.turn_radius_m;
  auto device = agent::SimulatedDevice::Open(run);
  if (!device) return tl::unexpected(device.error());
  agent::VirtualRobotOptions robot = options.robot;
  robot.seed = run.seed;
  agent::JoinNetwork(robot.topics, common);
  robot.stop = [] { return program::StopSignal::requested(); };
  const auto summary = agent::RunVirtualRobot(**device, robot);
  if (!summary) return tl::unexpected(summary.error());
  std::fputs(summary->Text().c_str(), stdout);
  return (*device)->TruthWritten();
}

}  // namespace

Command AddRobotCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<RobotOptions>();
  CLI::App* app = parent.add_subcommand(
      "robot", "A virtual robot that an agent drives as it would a real one, over ROS 2 topics");
  app->footer(kRobotExamples);
  app->option_defaults()->always_capture_default();
  agent::AddSimulatedOptions(*app, options->device, true)->required();
  app->add_flag("--scout", options->scout,
                "Drives itself along the path, as if by an operator, and stands at its end");
  CLI::Option* ros2 = app->add_option("--ros2", options->robot.topics.robot,
                                      "Its namespace, as '/robot1', or '/' for none");
  ros2->required();
  agent::AddRos2TopicOptions(*app, ros2, "Topics", options->robot.topics);
  options->robot.topics.scan = "scan";
  agent::AddScanTopicOption(*app, ros2, "Topics", options->robot.topics);
  options->robot.topics.imu = "imu";
  agent::AddImuTopicOption(*app, ros2, "Topics", options->robot.topics);
  options->robot.topics.battery = "battery_state";
  agent::AddBatteryTopicOption(*app, ros2, "Topics", options->robot.topics);
  options->robot.topics.ranges = {"range"};
  options->robot.range_mounts.resize(1);
  agent::AddRangeTopicOption(*app, ros2, "Topics", options->robot.topics,
                             options->robot.range_mounts);
  CLI::Option* lockstep = app->add_flag(
      "--lockstep", options->robot.lockstep,
      "Wait for the answer to each frame ('trailcast-agent ... --lockstep'), so that a slow "
      "machine changes nothing but the time it takes");
  program::AddSeveral(
      *app, "--fail", "FAULT@S", &agent::ParseRobotFault,
      [options](std::vector<agent::RobotFault> faults) {
        options->robot.faults = std::move(faults);
      },
      "What goes wrong S seconds after it was first told to drive, and with +S for how "
      "long: " +
          agent::RobotFaultNames())
      ->excludes(lockstep);
  program::AddSeveral(
      *app, "--obstacle", "X,Y,RADIUS@S", &agent::ParsePillar,
      [options](std::vector<agent::Pillar> pillars) {
        options->robot.obstacles = std::move(pillars);
      },
      "What stands where in the world, in metres, from S seconds after it was first told to "
      "drive, and with +S for how long; in what it scans and ranges alone, not in the pictures");
  AddTimingOptions(*app, lockstep, options->robot.timing);
  app->add_option("--turn-radius", options->turn_radius_m,
                  "Its base steers like a car's, no tighter than so many metres; 0: by two wheels")
      ->check(CLI::Range(0.0, 10.0));
  return {app, [app, options, &common] {
            program::SetUpLog(common);
            if (auto ran = Run(common, *options); !ran) return program::Complain(*app, ran.error());
            return program::kExitOk;
          }};
}

}  // namespace trailcast::tool
