#include "services/tool/robot_checkup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::tool {
namespace {

using Grade = Finding::Grade;

constexpr double kDark = 40.0;
constexpr double kBright = 215.0;
constexpr double kLeastContrast = 20.0;
constexpr double kLeastSharpness = 0.34;
constexpr double kFewestPictures_hz = 8.0;
constexpr double kFewestPoses_hz = 15.0;
constexpr double kFewestScans_hz = 5.0;
constexpr double kSameClock_s = 0.5;
constexpr double kLateStamps_s = 0.08;
constexpr double kLateBase_s = 0.4;
constexpr double kLeastTurn = 0.3;  // share of the commanded turn
constexpr double kMostTurn = 1.7;
constexpr double kLeastShift = 0.03;  // share of the width

Finding JudgeTopics(const agent::RobotMeasures& measures, const dds::Ros2Options& topics) {
  const auto missing = [&](const std::string& what, const std::string& advice) {
    return Finding{Grade::kBad, fmt::format("topics: {}", what), advice};
  };
  const std::string looked = fmt::format(
      "looked on {}, ROS domain {}: check the robot's drivers, its namespace and domain",
      measures.peers.tried, topics.domain_id);
  if (!measures.peers.mismatch.empty()) {
    return missing(
        "quality of service does not match: " + measures.peers.mismatch,
        "publish sensors reliably or best effort, volatile; listen to commands the same");
  }
  if (measures.pictures == 0) return missing("no picture came on " + topics.ImageTopic(), looked);
  if (measures.odometry == 0 && !measures.peers.unfit_odometry.empty()) {
    return missing(fmt::format("what comes on {} is no odometry: {}", topics.OdometryTopic(),
                               measures.peers.unfit_odometry),
                   "mend what publishes it");
  }
  if (!topics.odometry.empty() && measures.odometry == 0) {
    return missing("no odometry came on " + topics.OdometryTopic(),
                   measures.pictures > 0 ? "name its topic with --odom-topic" : looked);
  }
  if (measures.peers.bases == 0) {
    return missing(
        fmt::format("nobody listens to {} as {}", topics.CommandTopic(),
                    topics.command_type == dds::Ros2CommandType::kTwist ? "Twist" : "TwistStamped"),
        "try the other --cmd-vel-type, or name the topic with --cmd-vel-topic");
  }
  return {Grade::kGood, "topics: pictures, odometry and a base that listens", ""};
}

Finding JudgePicture(const agent::RobotMeasures& measures) {
  if (!measures.unreadable.empty()) {
    return {
        Grade::kBad, "picture: cannot be read: " + measures.unreadable,
        "have the camera publish mono8, rgb8, bgr8, YUV 4:2:2 or Bayer, or compressed pictures"};
  }
  const agent::PictureMeasures& picture = measures.picture;
  const std::string what =
      fmt::format("picture: {}x{}, brightness {:.0f} of 255, contrast {:.0f}, sharpness {:.2f}",
                  measures.width_px, measures.height_px, picture.brightness, picture.contrast,
                  picture.sharpness);
  if (picture.brightness < kDark) {
    return {Grade::kWarning, what, "it is dark: open the aperture, let the camera expose longer"};
  }
  if (picture.brightness > kBright) {
    return {Grade::kWarning, what, "it is overexposed: switch automatic exposure on"};
  }
  if (picture.contrast < kLeastContrast) {
    return {Grade::kWarning, what, "it is bland: clean the lens, turn the camera to where more is"};
  }
  if (picture.sharpness < kLeastSharpness) {
    return {Grade::kWarning, what, "it is blurred: focus the lens, wipe it, take the cap off"};
  }
  return {Grade::kGood, what, ""};
}

Finding JudgeRates(const agent::RobotMeasures& measures, bool has_odometry) {
  const std::string what =
      fmt::format("rates: {:.0f} pictures and {:.0f} odometry samples a second",
                  measures.picture_rate_hz, measures.odometry_rate_hz);
  if (measures.picture_rate_hz < kFewestPictures_hz) {
    return {Grade::kWarning, what,
            "few pictures: make them smaller (320 pixels wide is enough), or drive slower"};
  }
  if (has_odometry && measures.odometry_rate_hz < kFewestPoses_hz) {
    return {Grade::kWarning, what, "odometry is rare: have the base publish it 20 times a second"};
  }
  return {Grade::kGood, what, ""};
}

Finding JudgeStamps(const agent::RobotMeasures& measures) {
  if (measures.picture_stamps_stand || measures.odometry_stamps_stand) {
    return {Grade::kWarning,
            fmt::format("stamps: those of {} stand still",
                        measures.picture_stamps_stand ? "pictures" : "odometry"),
            "the time of arrival is taken for them; have the driver stamp what it publishes"};
  }
  const double apart_s = measures.clocks_apart_s.value_or(0.0);
  if (std::abs(apart_s) > kSameClock_s) {
    return {Grade::kWarning,
            fmt::format("stamps: pictures' are {:.2f} s {} odometry's", std::abs(apart_s),
                        apart_s > 0.0 ? "ahead of" : "behind"),
            "they are brought together by when they come; better: one clock for both (chrony)"};
  }
  const auto& turn = measures.turn;
  if (turn && turn->stamps_late_s && std::abs(*turn->stamps_late_s) > kLateStamps_s) {
    return {Grade::kWarning,
            fmt::format("stamps: by how both turn, pictures are stamped {:.2f} s {} odometry",
                        std::abs(*turn->stamps_late_s),
                        *turn->stamps_late_s > 0.0 ? "later than" : "earlier than"),
            "have the camera's driver stamp a picture when it is taken, not when it is published"};
  }
  return {Grade::kGood, "stamps: pictures and odometry agree", ""};
}

bool StandsOnItsSide(const agent::TurnMeasures& turn) {
  return std::abs(turn.picture_down_share) > std::max(kLeastShift, std::abs(turn.picture_share));
}

Finding JudgeTurn(const agent::TurnMeasures& turn) {
  const std::string what = fmt::format(
      "turn: told {:.0f} degrees to the left, odometry says {:.0f}, the picture moved "
      "{:.0f} % of its width to the {}",
      57.3 * turn.told_rad, 57.3 * turn.odometry_rad, 100.0 * std::abs(turn.picture_share),
      turn.picture_share > 0.0 ? "right" : "left");
  const double share = turn.odometry_rad / turn.told_rad;
  const bool seen = std::abs(turn.picture_share) > kLeastShift;
  if (std::abs(share) < kLeastTurn && !seen) {
    return {Grade::kBad, what,
            "the base stands: is it switched on, its emergency stop released, its minimum command "
            "below 0.4 rad/s?"};
  }
  if (StandsOnItsSide(turn)) {
    const bool down = turn.picture_down_share > 0.0;
    return {Grade::kBad, what + (down ? ", and more down" : ", and more up"),
            fmt::format("a picture moves to the right when its robot turns left: the camera stands "
                        "on its side; turn it, or add {} to --camera-roll",
                        down ? 270 : 90)};
  }
  if (seen && turn.picture_share < 0.0 && share > 0.0) {
    return {
        Grade::kBad, what,
        "a picture moves to the right when its robot turns left: is the camera upside down (then "
        "turn it, or add 180 to --camera-roll), its picture mirrored, or does the base turn right "
        "and say left?"};
  }
  if (share < 0.0) {
    return {Grade::kBad, what,
            seen && turn.picture_share < 0.0
                ? "the base turns right when it is told left: turn the sign of angular.z"
                : "odometry counts turns the wrong way: counter-clockwise is positive (REP 103)"};
  }
  if (share < kLeastTurn || share > kMostTurn) {
    return {Grade::kWarning, what,
            "odometry and commands are of different scales: check wheel base and radius"};
  }
  if (!seen) {
    return {Grade::kWarning, what,
            "the picture hardly moved: is it this robot's, and is something to be seen in it?"};
  }
  return {Grade::kGood, what, ""};
}

Finding JudgeDelay(const agent::TurnMeasures& turn) {
  if (!turn.base_delay_s) return {Grade::kWarning, "delay: no turn was seen by odometry", ""};
  const std::string what =
      fmt::format("delay: {:.2f} s from a command until odometry turns", *turn.base_delay_s);
  if (*turn.base_delay_s <= kLateBase_s) return {Grade::kGood, what, ""};
  return {
      Grade::kWarning, what,
      "the robot will swing: drive slower (--speed-factor 0.6), or shorten the way of commands"};
}

Finding Silent(const std::string& what, bool somebody_publishes) {
  if (!somebody_publishes) {
    return {Grade::kBad, what + ": nobody publishes it",
            "start its driver, or name the topic as 'ros2 topic list' has it"};
  }
  return {Grade::kBad, what + ": nothing came that can be one",
          "angles, steps and ranges have to be numbers, the field of view at most half a turn; "
          "listen to it with 'ros2 topic echo'"};
}

constexpr const char* kRare =
    "the robot is stopped when none comes for 0.3 s: have the driver publish 10 a second, or give "
    "--sensor-timeout";

Finding JudgeScan(const agent::RobotMeasures& measures, const dds::Ros2Options& topics) {
  const agent::ScanMeasures& scan = measures.scan;
  if (scan.scans == 0) return Silent("scan " + topics.ScanTopic(), measures.peers.scanners > 0);
  const std::string what = fmt::format("scan {}: {:.0f} a second, {} of {} ranges see something",
                                       topics.ScanTopic(), scan.rate_hz, scan.seen, scan.ranges);
  if (scan.seen == 0) {
    return {
        Grade::kWarning, what,
        "is it covered, or in the open with nothing within its range? Hold something before it"};
  }
  if (scan.within_robot > 0) {
    return {Grade::kBad,
            fmt::format(
                "{}, {} of them within the robot itself, one {:.2f} m {} its axle, {:.2f} m "
                "to the {}",
                what, scan.within_robot, std::abs(scan.first_within.x()),
                scan.first_within.x() >= 0.0 ? "ahead of" : "behind",
                std::abs(scan.first_within.y()), scan.first_within.y() >= 0.0 ? "left" : "right"),
            "it would wait for itself: say how wide it is and where its scanner is (--robot-width, "
            "--scan-ahead), or have the driver leave out what the robot hides"};
  }
  if (scan.rate_hz < kFewestScans_hz) return {Grade::kWarning, what, kRare};
  return {Grade::kGood, what, ""};
}

Finding JudgeRange(const agent::RobotMeasures& measures, const dds::Ros2Options& topics,
                   std::size_t sensor) {
  const std::string topic = "range " + topics.RangeTopic(sensor);
  const agent::RangeMeasures& range = measures.ranges[sensor];
  if (range.ranges == 0) {
    const auto& rangers = measures.peers.rangers;
    return Silent(topic, sensor < rangers.size() && rangers[sensor] > 0);
  }
  const std::string what =
      fmt::format("{}: {:.0f} a second, {}, a cone of {:.0f} degrees", topic, range.rate_hz,
                  motion::Points(range.last, {}).empty()
                      ? std::string("sees nothing")
                      : fmt::format("sees something at {:.2f} m",
                                    std::max<double>(range.last.range_m, range.last.least_m)),
                  57.3 * range.last.field_rad);
  if (range.rate_hz < kFewestScans_hz) return {Grade::kWarning, what, kRare};
  return {Grade::kGood, what, ""};
}

}  // namespace

std::vector<Finding> JudgeObstacleSensors(const agent::RobotMeasures& measures,
                                          const dds::Ros2Options& topics) {
  std::vector<Finding> findings;
  if (!topics.scan.empty()) findings.push_back(JudgeScan(measures, topics));
  for (std::size_t i = 0; i < topics.ranges.size(); ++i) {
    findings.push_back(JudgeRange(measures, topics, i));
  }
  return findings;
}

std::vector<Finding> JudgeRobot(const agent::RobotMeasures& measures,
                                const dds::Ros2Options& topics) {
  std::vector<Finding> findings{JudgeTopics(measures, topics)};
  if (measures.pictures == 0) return findings;
  findings.push_back(JudgePicture(measures));
  findings.push_back(JudgeRates(measures, !topics.odometry.empty()));
  const std::vector<Finding> sensors = JudgeObstacleSensors(measures, topics);
  findings.insert(findings.end(), sensors.begin(), sensors.end());
  if (measures.odometry > 0) findings.push_back(JudgeStamps(measures));
  if (measures.turn) {
    findings.push_back(JudgeTurn(*measures.turn));
    findings.push_back(JudgeDelay(*measures.turn));
  }
  return findings;
}

}  // namespace trailcast::tool
