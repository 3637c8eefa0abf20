#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "agent/device/device_options.h"
#include "agent/device/robot_measures.h"
#include "services/program/stop_signal.h"
#include "services/tool/checkup.h"
#include "services/tool/commands/command.h"
#include "services/tool/robot_checkup.h"

namespace trailcast::tool {
namespace {

constexpr const char* kDoctorExamples =
    "Examples:\n"
    "  trailcast doctor\n"
    "  trailcast doctor --network-interface wlan0 --folder /var/lib/trailcast\n"
    "  trailcast doctor --ros2 /robot1          # looks at a robot's camera, odometry and stamps\n"
    "  trailcast doctor --ros2 /robot1 --scan-topic scan --robot-width 0.4\n"
    "  trailcast doctor --ros2 /robot1 --turn   # and turns it to the left and back: make room\n"
    "Exit status: 1 if anything is BAD.";

struct DoctorOptions {
  std::string folder = ".";
  agent::MeasureOptions robot;
  double turn_radius_m = 0.0;
};

// A car drives a bit of its tightest circle.
constexpr double kCarSpeed_mps = 0.2;

Result<std::vector<Finding>> ExamineRobot(const program::CommonOptions& common,
                                          const DoctorOptions& options) {
  const program::StopSignal stop;
  agent::MeasureOptions robot = options.robot;
  agent::JoinNetwork(robot.topics, common);
  robot.stop = [] { return program::StopSignal::requested(); };
  if (options.turn_radius_m > 0.0) {
    robot.turn_command = {kCarSpeed_mps, kCarSpeed_mps / options.turn_radius_m};
  }
  const auto measures = agent::MeasureRobot(robot);
  if (!measures) return tl::unexpected(measures.error());
  return JudgeRobot(*measures, robot.topics);
}

Result<int> Run(const program::CommonOptions& common, const DoctorOptions& options) {
  std::vector<Finding> findings = ExamineMachine(options.folder, common.network_interface);
  if (!options.robot.topics.robot.empty()) {
    const auto robot = ExamineRobot(common, options);
    if (!robot) return tl::unexpected(robot.error());
    findings.insert(findings.end(), robot->begin(), robot->end());
  }
  std::fputs(CheckupText(findings).c_str(), stdout);
  const bool bad = std::any_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.grade == Finding::Grade::kBad;
  });
  return bad ? program::kExitFailure : program::kExitOk;
}

}  // namespace

Command AddDoctorCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* app = parent.add_subcommand(
      "doctor", "Look whether this machine, or a robot, is fit, and say what to change");
  app->footer(kDoctorExamples);
  app->option_defaults()->always_capture_default();
  app->add_option("--folder", options->folder, "Where routes are to be kept");
  const std::string robot = "ROS 2 robot (no ROS needed)";
  CLI::Option* ros2 = app->add_option("--ros2", options->robot.topics.robot,
                                      "Its namespace, as '/robot1', or '/' for none");
  ros2->group(robot);
  CLI::Option* turn =
      app->add_flag("--turn", options->robot.turn,
                    "Turns it to the left and back, a second and a half each: make room")
          ->needs(ros2)
          ->group(robot);
  app->add_option("--min-turn-radius", options->turn_radius_m,
                  "Metres, of a car, which drives 30 cm to and fro for that")
      ->needs(turn)
      ->check(CLI::Range(0.0, 10.0))
      ->group(robot);
  agent::AddRos2TopicOptions(*app, ros2, robot, options->robot.topics);
  agent::AddObstacleSensorOptions(*app, ros2, options->robot.topics, options->robot.obstacles);
  agent::AddCameraRoll(*app, options->robot.intake);
  return {app, [app, options, &common] {
            program::SetUpLog(common);
            const auto ran = Run(common, *options);
            return ran ? *ran : program::Complain(*app, ran.error());
          }};
}

}  // namespace trailcast::tool
