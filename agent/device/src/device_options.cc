#include "agent/device/device_options.h"

#include <spdlog/spdlog.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "services/base/angles.h"
#include "services/base/csv_line.h"
#include "services/base/number.h"
#include "services/program/parses_by.h"
#include "services/program/several.h"
#include "services/program/stop_signal.h"

namespace trailcast::agent {
namespace {

CLI::Option* AddRecordedOptions(CLI::App& command, RecordedRun& recorded) {
  const std::string recording = "Recorded run";
  auto* frames = command.add_option(
      "--frames", recorded.frames,
      "Folder of pictures (in the order of their names, f2 before f10) or video");
  frames->group(recording);
  command
      .add_option("--odometry", recorded.odometry,
                  "CSV t_s,x_m,y_m,heading_rad, times counted from the first frame, or by the same "
                  "clock as --frame-times")
      ->needs(frames)
      ->group(recording);
  CLI::Option* rate = command
                          .add_option("--rate", recorded.rate_hz,
                                      "Frames a second; default: the video's own, or 30")
                          ->check(CLI::Range(0.1, 1000.0))
                          ->needs(frames)
                          ->group(recording);
  command
      .add_option("--frame-times", recorded.frame_times,
                  "CSV t_s: when each frame was taken, a line a frame, in their order")
      ->needs(frames)
      ->excludes(rate)
      ->group(recording);
  return frames;
}

CLI::Option* AddBagOption(CLI::App& command, BagRun& run, CLI::Option* frames) {
  auto* bag = command.add_option("--bag", run.bag,
                                 "What a robot's own tools recorded: a rosbag2 folder, .db3 or "
                                 ".mcap file; by --image-topic and --odom-topic, or the only ones "
                                 "there are");
  bag->group("Recorded run")->excludes(frames);
  return bag;
}

// A user who gives the robot's width expects it to stop before obstacles.
void CheckObstacleOptions(const CLI::App& command, const dds::Ros2Options& topics) {
  for (const char* name : {"--scan-ahead", "--robot-width", "--obstacle-gap"}) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option == nullptr || option->count() == 0) continue;
    if (topics.scan.empty() && topics.ranges.empty()) {
      throw CLI::RequiresError(name, "--scan-topic or --range-topic");
    }
  }
}

// These checks need all options to be read.
void CheckTogether(CLI::App& command, DeviceOptions& options, DeviceUse use) {
  command.callback([&command, &options, use] {
    const bool image = command.count("--image-topic") > 0;
    const bool odometry = command.count("--odom-topic") > 0;
    if (!options.is_recorded() && !options.is_simulated() && options.ros2.topics.robot.empty()) {
      throw CLI::RequiredError(use == DeviceUse::kOnDuty ? "--sim or --ros2"
                                                         : "--frames, --bag, --sim or --ros2");
    }
    if ((image || odometry) && options.bag.bag.empty() && options.ros2.topics.robot.empty()) {
      throw CLI::RequiresError(image ? "--image-topic" : "--odom-topic", "--ros2 or --bag");
    }
    CheckObstacleOptions(command, options.ros2.topics);
    if (options.pass_obstacles_m > 0.0 && options.ros2.topics.scan.empty()) {
      throw CLI::RequiresError("--pass-obstacles", "--scan-topic");
    }
    if (options.pass_obstacles_m > 0.0 && options.ros2.topics.odometry.empty()) {
      throw CLI::RequiresError("--pass-obstacles", "--odom-topic");
    }
    TakeTopics(command, options.ros2.topics, options.bag);
  });
}

CLI::Option* AddRos2Options(CLI::App& command, DeviceOptions& options, bool scout) {
  const std::string robot = "ROS 2 robot (no ROS needed)";
  dds::Ros2Options& topics = options.ros2.topics;
  auto* ros2 = command.add_option("--ros2", topics.robot,
                                  "The robot's namespace, as '/robot1', or '/' for none");
  ros2->group(robot);
  const auto add = [&](const std::string& flag, auto& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(ros2)->group(robot);
  };
  AddRos2TopicOptions(command, ros2, robot, topics);
  AddBatteryTopicOption(command, ros2, robot, topics);
  add("--camera-name", options.ros2.camera, "The camera's make, for the catalog");
  add("--sensor-timeout", options.sensor_timeout_s,
      "Seconds without a picture, odometry, a scan, a range or an obeying base until the robot is "
      "stopped")
      ->check(CLI::Range(0.1, 60.0));
  add("--sensor-patience", options.sensor_patience_s,
      "Seconds that a stopped robot waits for them to come back")
      ->check(CLI::Range(0.0, 3600.0));
  if (!scout) {
    add("--base-patience", options.base_patience_s,
        "Seconds that a base may stand against its commands, held by a safety stop or blocked: it "
        "is told to stand, and tried now and then, gently")
        ->check(CLI::Range(0.0, 86400.0));
    AddDriveLimits(command, ros2, options.ros2.limits);
  }
  command
      .add_flag("--lockstep", options.ros2.lockstep,
                "The robot waits for the answer to each frame ('trailcast robot --lockstep')")
      ->needs(ros2)
      ->group(robot);
  if (!scout) {
    AddObstacleSensorOptions(command, ros2, topics, options.ros2.obstacles);
    command
        .add_option("--obstacle-gap", options.ros2.obstacles.gap_m,
                    "Metres from what stands in its way at which the robot waits until it is gone; "
                    "no protection of people")
        ->check(CLI::Range(0.05, 5.0))
        ->needs(ros2)
        ->group("What stands in its way");
    command
        .add_option("--pass-obstacles", options.pass_obstacles_m,
                    "Metres beside the taught path to which the robot may go round what its "
                    "scanner sees on it, by odometry and the default method; 0: it waits before it")
        ->check(CLI::Range(0.0, 2.0))
        ->needs(ros2)
        ->group("What stands in its way");
  }
  if (scout) {
    AddImuTopicOption(command, ros2, robot, topics);
    add("--end-when-still", options.still_at_end_s,
        "Seconds of standing, after it has moved, that end the route: by its odometry, or by what "
        "it sees if it has none; 0: only a signal ends it")
        ->check(CLI::Range(0.0, 3600.0));
  }
  return ros2;
}

std::string WhatIsHeard(const dds::Ros2Options& topics) {
  std::string text = "pictures from " + topics.ImageTopic();
  text += topics.odometry.empty() ? ", no odometry: vision only"
                                  : ", odometry from " + topics.OdometryTopic();
  if (!topics.scan.empty()) text += ", scans from " + topics.ScanTopic();
  for (std::size_t i = 0; i < topics.ranges.size(); ++i) {
    text += ", ranges from " + topics.RangeTopic(i);
  }
  if (!topics.imu.empty()) text += ", an IMU on " + topics.ImuTopic();
  if (!topics.battery.empty()) text += ", a battery on " + topics.BatteryTopic();
  return text;
}

template <std::size_t kCount>
std::optional<std::array<double, kCount>> ParseNumbers(const std::string& text) {
  const auto cells = CsvCells(text);
  if (!cells || cells->size() != kCount) return std::nullopt;
  std::array<double, kCount> numbers{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto number = ParseNumber<double>((*cells)[i]);
    if (!number || !std::isfinite(*number)) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

// Parses "3,1.5,1,0.01": place, radius and height.
Result<RoughGround> ParseRoughPatch(const std::string& text) {
  const auto numbers = ParseNumbers<4>(text);
  if (!numbers || !((*numbers)[2] > 0.0) || (*numbers)[3] < 0.0 || (*numbers)[3] > 0.1) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' is no rough ground: expected X,Y,RADIUS,HEIGHT in metres, its bumps 0.1 high "
                "at most, as 3,1.5,1,0.01",
                text);
  }
  const auto [x_m, y_m, radius_m, height_m] = *numbers;
  return RoughGround{x_m, y_m, radius_m, height_m};
}

// Parses "9,6.5,90@4": place, heading in degrees, and metres driven before.
Result<CarriedOff> ParseCarriedOff(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto to = ParseNumbers<3>(text.substr(0, at));
  const auto after_m = at == std::string::npos
                           ? std::nullopt
                           : ParseNumber<double>(std::string_view(text).substr(at + 1));
  if (!to || !after_m || !std::isfinite(*after_m) || *after_m < 0.0) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' does not say where a robot is carried: expected X,Y,DEGREES@METRES, where in "
                "the world it is set down, looking which way, and how far it has driven by then, "
                "as 9,6.5,90@4",
                text);
  }
  return CarriedOff{*after_m, {(*to)[0], (*to)[1], Radians((*to)[2])}};
}

// Parses "1.5,1.5@10": place, and minutes to charge an empty battery.
Result<Charger> ParseCharger(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto place = ParseNumbers<2>(text.substr(0, at));
  const auto minutes = at == std::string::npos
                           ? std::nullopt
                           : ParseNumberWithin(std::string_view(text).substr(at + 1), 0.1, 1e5);
  if (!place || !minutes) {
    return Fail(ErrorCode::kInvalidArgument,
                "'{}' is no charger: expected X,Y@MINUTES, where in the world it is, and how many "
                "minutes it takes to charge an empty battery, as 1.5,1.5@10",
                text);
  }
  return Charger{(*place)[0], (*place)[1], *minutes};
}

CLI::Option* AddCharger(CLI::App& command, std::optional<Charger>& charger) {
  return command
      .add_option_function<std::string>(
          "--sim-charger",
          [&charger](const std::string& text) { charger = ParseCharger(text).value(); },
          "Its battery charges within half a metre of this place in the world, from empty to full "
          "in so many of its minutes")
      ->check(program::ParsesBy(ParseCharger, "X,Y@MINUTES"));
}

CLI::Option* AddCarriedOff(CLI::App& command, std::optional<CarriedOff>& carried) {
  return command
      .add_option_function<std::string>(
          "--sim-carry",
          [&carried](const std::string& text) { carried = ParseCarriedOff(text).value(); },
          "Somebody takes it up once it has driven so far, and sets it down there in the world, "
          "looking so many degrees to the left of the x-axis; its wheels do not feel it")
      ->check(program::ParsesBy(ParseCarriedOff, "X,Y,DEGREES@METRES"));
}

CLI::Option* AddRoughPatches(CLI::App& command, std::vector<RoughGround>& patches) {
  return program::AddSeveral(
      command, "--rough", "X,Y,RADIUS,HEIGHT", &ParseRoughPatch,
      [&patches](std::vector<RoughGround> given) { patches = std::move(given); },
      "Where in the world its wheels feel bumps, so high (RMS), in metres");
}

Result<std::unique_ptr<RobotDevice>> OpenRos2(const DeviceOptions& options,
                                              const program::CommonOptions& network) {
  Ros2Run run = options.ros2;
  JoinNetwork(run.topics, network);
  run.sensor_timeout = ToMilliseconds(options.sensor_timeout_s);
  run.patience = ToMilliseconds(options.sensor_patience_s);
  run.base_patience = ToMilliseconds(options.base_patience_s);
  run.still_at_end = ToMilliseconds(options.still_at_end_s);
  run.stop = [] { return program::StopSignal::requested(); };
  auto device = Ros2Device::Open(run);
  if (!device) return tl::unexpected(device.error());
  spdlog::info("robot {}: {}, commands to {}, ROS domain {}", run.topics.robot,
               WhatIsHeard(run.topics), run.topics.CommandTopic(), run.topics.domain_id);
  return device;
}

}  // namespace

RecordingFlags AddRecordingOptions(CLI::App& command, RecordedRun& recorded, BagRun& bag) {
  RecordingFlags flags;
  flags.frames = AddRecordedOptions(command, recorded);
  flags.bag = AddBagOption(command, bag, flags.frames);
  return flags;
}

void ShareTopics(CLI::App& command, CLI::Option* robot) {
  for (const char* name : {"--image-topic", "--odom-topic"}) {
    command.get_option(name)->remove_needs(robot);
  }
}

void TakeTopics(const CLI::App& command, const dds::Ros2Options& topics, BagRun& bag) {
  if (command.count("--image-topic") > 0) bag.image_topic = topics.image;
  if (command.count("--odom-topic") > 0) bag.odom_topic = topics.odometry;
  if (command.count("--cmd-vel-topic") > 0) bag.command_topic = topics.command;
}

CLI::Option* AddSimulatedOptions(CLI::App& command, DeviceOptions& options, bool scout) {
  SimulatedRun& simulated = options.simulated;
  simulated.drives_itself = scout;
  const std::string simulation = "Simulated robot";
  auto* world = command.add_option("--sim", simulated.place.world,
                                   "World: a built-in one's name, or a file (.obj, .glb, ...)");
  world->group(simulation);
  const auto add = [&](const std::string& flag, auto& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(world)->group(simulation);
  };
  add("--camera", simulated.camera,
      "Built-in camera's name, or a .toml file; with what is other about it, by that file's keys: "
      "webcam+roll_deg=180+ahead_m=0.3");
  add("--seed", simulated.seed, "Draws this robot's errors and noise");
  add("--path", simulated.place.path,
      "CSV x_m,y_m: the taught path, turned on the spot where it doubles back; default: the "
      "built-in world's own");
  add("--up", simulated.place.up, "Axis that is up in a world file")
      ->check(CLI::IsMember({"y", "z"}));
  add("--scale", simulated.place.scale, "Metres per unit of a world file")
      ->check(CLI::PositiveNumber);
  add("--ground", simulated.place.ground, "What robots stand on")
      ->check(CLI::IsMember({"mesh", "flat"}));
  if (scout) {
    add("--speed", simulated.speed_mps,
        "How fast the scout is driven, m/s; default: the place's own")
        ->default_str("")
        ->check(CLI::Range(0.05, 2.0));
  }
  AddRoughPatches(command, simulated.rough)->needs(world)->group(simulation);
  AddCarriedOff(command, simulated.carried)->needs(world)->group(simulation);
  auto* battery =
      add("--sim-battery", simulated.battery_minutes,
          "How many of its minutes a full battery lasts; default: it does not tell of any")
          ->default_str("")
          ->check(CLI::Range(0.1, 100'000.0));
  AddCharger(command, simulated.charger)->needs(battery)->group(simulation);
  add("--sim-truth", options.simulated.truth, "Writes the true poses here as it goes, for a judge");
  return world;
}

void JoinNetwork(dds::Ros2Options& topics, const program::CommonOptions& network) {
  if (topics.network_interface.empty()) topics.network_interface = network.network_interface;
}

void AddDriveLimits(CLI::App& command, CLI::Option* robot, motion::DriveLimits& limits) {
  const auto add = [&](const std::string& flag, double& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(robot)->group("What its base can do");
  };
  add("--max-speed", limits.speed_mps, "Metres a second; the turning rate is reduced with it")
      ->check(CLI::Range(0.05, 10.0));
  add("--max-turn-rate", limits.turn_rate_radps,
      "Radians a second; the speed is reduced with it, so that the path stays the same")
      ->check(CLI::Range(0.05, 10.0));
  add("--max-acceleration", limits.acceleration_mps2,
      "Metres a second, each second, when it speeds up")
      ->check(CLI::Range(0.05, 10.0));
  add("--min-turn-radius", limits.turn_radius_m,
      "Metres, of a car with a steering axle; 0: it turns on the spot")
      ->check(CLI::Range(0.0, 10.0));
}

void AddRos2TopicOptions(CLI::App& command, CLI::Option* robot, const std::string& group,
                         dds::Ros2Options& topics) {
  const auto add = [&](const std::string& flag, auto& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(robot)->group(group);
  };
  // People who work with ROS have it in the environment, where it must not require a robot.
  command.add_option("--ros-domain", topics.domain_id, "The robot's ROS_DOMAIN_ID")
      ->group(group)
      ->check(CLI::Range(0, 230))
      ->envname("ROS_DOMAIN_ID");
  add("--ros-interface", topics.network_interface,
      "Network interface of the robot's own topics, as 'lo' where its nodes run on this computer; "
      "default: --network-interface");
  add("--ros-dds-tag", topics.discovery_tag,
      "DDS domain tag of the robot's own topics; real robots have none");
  add("--image-topic", topics.image,
      "sensor_msgs/Image, or CompressedImage if it ends with '/compressed'; below the namespace "
      "unless it begins with '/'");
  add("--odom-topic", topics.odometry, "nav_msgs/Odometry; '' for a robot that has none");
  add("--cmd-vel-topic", topics.command, "geometry_msgs/Twist or TwistStamped");
  command
      .add_option_function<std::string>(
          "--cmd-vel-type",
          [&topics](const std::string& type) {
            topics.command_type = type == "twist" ? dds::Ros2CommandType::kTwist
                                                  : dds::Ros2CommandType::kTwistStamped;
          },
          "What the base listens to; default: twist_stamped")
      ->default_str("")
      ->check(CLI::IsMember({"twist", "twist_stamped"}))
      ->needs(robot)
      ->group(group);
}

CLI::Option* AddScanTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                dds::Ros2Options& topics) {
  return command
      .add_option("--scan-topic", topics.scan,
                  "sensor_msgs/LaserScan, its angle 0 straight ahead; '' for none")
      ->needs(robot)
      ->group(group);
}

CLI::Option* AddRangeTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                 dds::Ros2Options& topics,
                                 std::vector<std::optional<motion::Pose2>>& mounts) {
  const auto take = [&topics, &mounts](const std::vector<RangeSensor>& sensors) {
    topics.ranges.clear();
    mounts.clear();
    for (const RangeSensor& sensor : sensors) {
      if (sensor.topic.empty()) continue;
      topics.ranges.push_back(sensor.topic);
      mounts.push_back(sensor.mount);
    }
  };
  return program::AddSeveral(
             command, "--range-topic", "TOPIC[@AHEAD,LEFT,DEGREES]", &ParseRangeSensor, take,
             "sensor_msgs/Range of a sonar or infrared sensor in the middle of its front, straight "
             "ahead; or so many metres from the axle, turned to the left; '' for none")
      ->needs(robot)
      ->group(group);
}

void AddObstacleSensorOptions(CLI::App& command, CLI::Option* robot, dds::Ros2Options& topics,
                              ObstacleOptions& obstacles) {
  const std::string group = "What stands in its way";
  AddScanTopicOption(command, robot, group, topics);
  AddRangeTopicOption(command, robot, group, topics, obstacles.range_mounts);
  const auto add = [&](const std::string& flag, double& value, const std::string& text) {
    return command.add_option(flag, value, text)->needs(robot)->group(group);
  };
  add("--scan-ahead", obstacles.scan_ahead_m,
      "Metres from the axle that the robot turns about ahead to its scanner")
      ->check(CLI::Range(-2.0, 2.0));
  add("--robot-width", obstacles.robot_width_m,
      "Metres, the whole; the robot is taken to reach as far ahead of its axle as half of it, or "
      "to its scanner if that is further")
      ->check(CLI::Range(0.05, 3.0));
}

CLI::Option* AddImuTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                               dds::Ros2Options& topics) {
  return command
      .add_option(
          "--imu-topic", topics.imu,
          "sensor_msgs/Imu in the base's frame, by which the route knows how rough and steep "
          "its ground is; '' for none")
      ->needs(robot)
      ->group(group);
}

CLI::Option* AddBatteryTopicOption(CLI::App& command, CLI::Option* robot, const std::string& group,
                                   dds::Ros2Options& topics) {
  return command
      .add_option("--battery-topic", topics.battery,
                  "sensor_msgs/BatteryState, of which operators are told; '' for none")
      ->needs(robot)
      ->group(group);
}

CLI::Validator CameraRollValidator() {
  return {[](std::string& text) {
            double roll_deg = 0.0;
            if (!CLI::detail::lexical_cast(text, roll_deg)) return "'" + text + "' is no number";
            const auto checked = vision::CheckRoll(roll_deg);
            return checked ? std::string() : checked.error().message;
          },
          "DEGREES"};
}

CLI::Validator CameraAheadRange() { return CLI::Range(-2.0, 2.0); }

void AddCameraRoll(CLI::App& command, vision::IntakeOptions& intake) {
  command
      .add_option(
          "--camera-roll", intake.roll_deg,
          "Degrees by which the camera is rolled about where it looks, clockwise as seen "
          "from behind it: 180 hangs upside down, 90 stands on its right side; quarter turns "
          "are found out, by the robot's turns, if nobody says so")
      ->check(CameraRollValidator())
      ->group("Camera");
}

void AddDeviceOptions(CLI::App& command, DeviceOptions& options, DeviceUse use) {
  const bool scout = use == DeviceUse::kTeach;
  RecordingFlags recording;
  if (use != DeviceUse::kOnDuty) {
    recording = AddRecordingOptions(command, options.recorded, options.bag);
  }
  auto* world = AddSimulatedOptions(command, options, scout);
  auto* ros2 = AddRos2Options(command, options, scout);
  ros2->excludes(world);
  if (recording.frames != nullptr) {
    world->excludes(recording.frames)->excludes(recording.bag);
    ros2->excludes(recording.frames)->excludes(recording.bag);
    ShareTopics(command, ros2);
  }
  AddCameraRoll(command, options.intake);
  if (!scout) {
    command
        .add_option("--camera-ahead", options.camera_ahead_m,
                    "Metres from the axle that the robot turns about ahead to its camera, more "
                    "than on the robot that taught; untold, it is learnt on the way")
        ->check(CameraAheadRange())
        ->group("Camera");
  }
  CheckTogether(command, options, use);
}

Result<void> OpenedDevice::TruthWritten() const {
  return simulated == nullptr ? Result<void>() : simulated->TruthWritten();
}

Result<OpenedDevice> OpenDevice(const DeviceOptions& options,
                                const program::CommonOptions& network) {
  OpenedDevice opened;
  if (options.is_simulated()) {
    auto device = OpenSimulatedRobot(options.simulated);
    if (!device) return tl::unexpected(device.error());
    opened.simulated = device->get();
    opened.device = std::move(*device);
    return opened;
  }
  if (!options.is_recorded()) {
    auto device = OpenRos2(options, network);
    if (!device) return tl::unexpected(device.error());
    opened.device = std::move(*device);
    return opened;
  }
  if (!options.bag.bag.empty()) {
    auto device = BagDevice::Open(options.bag);
    if (!device) return tl::unexpected(device.error());
    spdlog::info("{}: {}", (*device)->camera(), (*device)->sources());
    opened.device = std::move(*device);
    return opened;
  }
  auto device = RecordedDevice::Open(options.recorded);
  if (!device) return tl::unexpected(device.error());
  spdlog::info("{}, {}{}", (*device)->camera(), (*device)->timing(),
               (*device)->has_odometry() ? ", with odometry" : ", no odometry: vision only");
  opened.device = std::move(*device);
  return opened;
}

}  // namespace trailcast::agent
