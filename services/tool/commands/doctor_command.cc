#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "agent/device/device_options.h"
#include "agent/device/drive_look.h"
#include "agent/device/robot_measures.h"
#include "services/base/angles.h"
#include "services/program/stop_signal.h"
#include "services/tool/checkup.h"
#include "services/tool/commands/command.h"
#include "services/tool/odometry_checkup.h"
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
    "  trailcast doctor --ros2 /robot1 --drive  # what its odometry is worth, while you drive it\n"
    "  trailcast doctor --bag drive1/ --fov 62  # the same of a recording, and nothing else\n"
    "  trailcast doctor --frames drive1/ --rate 20 --odometry wheels.csv\n"
    "\n"
    "Odometry is held against what the pictures show: how late it is, how far it turns, what it\n"
    "drifts by, where it is frozen, slips or jumps. Drive some metres, with turns to either side;\n"
    "best once round, so that what was seen first is seen again: that tells how far it turns\n"
    "without --fov. Pictures alone tell no metres.\n"
    "\n"
    "Exit status: 1 if anything is BAD.";

struct DoctorOptions {
  std::string folder = ".";
  agent::MeasureOptions robot;
  double turn_radius_m = 0.0;
  agent::DeviceOptions drive;  // a recording
  std::optional<double> drive_s;
  std::optional<double> fov_deg;
};

// A car drives along a piece of its tightest circle.
constexpr double kCarSpeed_mps = 0.2;
constexpr double kDrive_s = 60.0;

Result<std::vector<Finding>> ExamineDrive(const program::CommonOptions& common,
                                          const DoctorOptions& options,
                                          const agent::DeviceOptions& device) {
  const auto opened = agent::OpenDevice(device, common);
  if (!opened) return tl::unexpected(opened.error());
  agent::DriveLookOptions look;
  look.intake = options.robot.intake;
  std::optional<double> fov_rad;
  if (options.fov_deg) {
    fov_rad = Radians(*options.fov_deg);
    look.focal_share = FocalShare(*fov_rad);
  }
  look.enough = [&](double lasts_s) {
    return program::StopSignal::requested() || (options.drive_s && lasts_s >= *options.drive_s);
  };
  opened->device->ByHand(true);
  const auto drive = agent::LookAtDrive(*opened->device, look);
  if (!drive) return tl::unexpected(drive.error());
  return JudgeOdometry(*drive, fov_rad);
}

Result<std::vector<Finding>> ExamineRobot(const program::CommonOptions& common,
                                          const DoctorOptions& options) {
  agent::MeasureOptions robot = options.robot;
  agent::JoinNetwork(robot.topics, common);
  robot.stop = [] { return program::StopSignal::requested(); };
  if (options.turn_radius_m > 0.0) {
    robot.turn_command = {kCarSpeed_mps, kCarSpeed_mps / options.turn_radius_m};
  }
  const auto measures = agent::MeasureRobot(robot);
  if (!measures) return tl::unexpected(measures.error());
  std::vector<Finding> findings = JudgeRobot(*measures, robot.topics);
  // The findings above name what is missing.
  const bool comes = measures->pictures > 0 && measures->odometry > 0;
  if (!options.drive_s || !comes || program::StopSignal::requested()) return findings;
  std::fprintf(stderr,
               "Drive the robot now, some metres and turns to either side, best once round: for "
               "%.0f s, or until Ctrl-C.\n",
               *options.drive_s);
  agent::DeviceOptions device;
  device.ros2.topics = options.robot.topics;
  device.ros2.topics.hear_commands = true;
  const auto drive = ExamineDrive(common, options, device);
  if (!drive) return tl::unexpected(drive.error());
  findings.insert(findings.end(), drive->begin(), drive->end());
  return findings;
}

Result<std::vector<Finding>> Examine(const program::CommonOptions& common,
                                     const DoctorOptions& options) {
  // The machine of a recording need not be fit for anything.
  if (options.drive.is_recorded()) return ExamineDrive(common, options, options.drive);
  std::vector<Finding> findings = ExamineMachine(options.folder, common.network_interface);
  if (options.robot.topics.robot.empty()) return findings;
  const auto robot = ExamineRobot(common, options);
  if (!robot) return robot;
  findings.insert(findings.end(), robot->begin(), robot->end());
  return findings;
}

Result<int> Run(const program::CommonOptions& common, const DoctorOptions& options) {
  const program::StopSignal stop;
  const auto findings = Examine(common, options);
  if (!findings) return tl::unexpected(findings.error());
  std::fputs(CheckupText(*findings).c_str(), stdout);
  const bool bad = std::any_of(findings->begin(), findings->end(), [](const Finding& finding) {
    return finding.grade == Finding::Grade::kBad;
  });
  return bad ? program::kExitFailure : program::kExitOk;
}

void AddDriveOptions(CLI::App& app, CLI::Option* ros2, DoctorOptions& options) {
  const auto flags = agent::AddRecordingOptions(app, options.drive.recorded, options.drive.bag);
  CLI::Option* drive =
      app.add_option("--drive", options.drive_s,
                     "What odometry is worth, while somebody drives the robot by hand: for so many "
                     "seconds, or until Ctrl-C; it is told nothing itself")
          ->needs(ros2)
          ->expected(0, 1)
          ->default_str(fmt::format("{:g}", kDrive_s))
          ->check(CLI::Range(5.0, 3600.0))
          ->group(ros2->get_group());
  CLI::Option* fov = app.add_option("--fov", options.fov_deg,
                                    "Degrees that the camera sees across, left to right: tells how "
                                    "far odometry turns; untold, a whole turn does")
                         ->check(CLI::Range(10.0, 175.0))
                         ->group("Camera");
  ros2->excludes(flags.frames)->excludes(flags.bag);
  agent::ShareTopics(app, ros2);
  app.get_option("--cmd-vel-topic")->remove_needs(ros2);
  app.callback([&app, &options, drive, fov] {
    agent::TakeTopics(app, options.robot.topics, options.drive.bag);
    options.drive.bag.hear_commands = true;
    if (fov->count() > 0 && drive->count() == 0 && !options.drive.is_recorded()) {
      throw CLI::RequiresError("--fov", "--drive, --bag or --frames");
    }
  });
}

}  // namespace

Command AddDoctorCommand(CLI::App& parent, const program::CommonOptions& common) {
  auto options = std::make_shared<DoctorOptions>();
  CLI::App* app = parent.add_subcommand(
      "doctor",
      "Look whether this machine, a robot, or a drive's odometry is fit, and say what to change");
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
  AddDriveOptions(*app, ros2, *options);
  agent::AddCameraRoll(*app, options->robot.intake);
  return {app, [app, options, &common] {
            program::SetUpLog(common);
            const auto ran = Run(common, *options);
            return ran ? *ran : program::Complain(*app, ran.error());
          }};
}

}  // namespace trailcast::tool
