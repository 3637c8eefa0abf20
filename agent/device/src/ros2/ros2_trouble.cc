#include "agent/device/src/ros2/ros2_trouble.h"

#include <fmt/format.h>

namespace trailcast::agent {
namespace {

std::string MismatchIfAny(const dds::Ros2Driver::Peers& peers) {
  if (peers.mismatch.empty()) return {};
  return fmt::format(
      "; quality of service does not match: {}: have the robot publish sensors, and listen to "
      "commands, reliably or best effort, volatile and without a deadline",
      peers.mismatch);
}

std::string ClosedIfAny(const dds::Ros2Driver::Peers& peers) {
  if (peers.closed.empty()) return {};
  return fmt::format(
      "; {} {} there without showing a topic, as nodes with DDS Security (SROS 2) are: start the "
      "robot's nodes without it (ROS_SECURITY_ENABLE=false)",
      fmt::join(peers.closed, ", "), peers.closed.size() == 1 ? "is" : "are");
}

}  // namespace

std::string TroubleText(const dds::Ros2Options& topics, const dds::Ros2Driver::Peers& peers,
                        const RobotWatch::Trouble& trouble, bool stamps_stand) {
  using Part = RobotWatch::Trouble::Part;
  switch (trouble.part) {
    case Part::kCamera:
      return fmt::format("camera {}: {}", topics.ImageTopic(), trouble.what);
    case Part::kOdometry:
      if (!peers.unfit_odometry.empty()) {
        return fmt::format("odometry {}: it comes, but {}", topics.OdometryTopic(),
                           peers.unfit_odometry);
      }
      return fmt::format("odometry {}: {}{}", topics.OdometryTopic(), trouble.what,
                         stamps_stand ? ": it comes, but its stamps do not advance" : "");
    case Part::kScan:
      return fmt::format("scan {}: {}", topics.ScanTopic(), trouble.what);
    case Part::kRange:
      return fmt::format("range {}: {}", topics.RangeTopic(trouble.sensor), trouble.what);
    case Part::kObstacle:
    case Part::kCrowd:
      return trouble.what;
    case Part::kBase:
      break;
  }
  return fmt::format("base {}: {}", topics.CommandTopic(), trouble.what);
}

std::string NoRoomText(const std::optional<PacketPieces>& pieces) {
  if (!pieces || !pieces->full()) return {};
  return fmt::format(
      "; packets of which pieces were lost fill the {:.0f} MB that this computer has for such, and "
      "keep pictures out for up to {} s; as root: {}",
      1e-6 * static_cast<double>(pieces->most_bytes), pieces->kept_s, pieces->more());
}

std::string WhoIsMissing(const dds::Ros2Options& topics, const dds::Ros2Driver::Peers& peers,
                         const Came& came) {
  std::string text;
  if (peers.cameras == 0) {
    text = fmt::format("nobody publishes {}", topics.ImageTopic());
  } else if (!came.pictures) {
    text = fmt::format("no picture came on {}", topics.ImageTopic());
  } else if (!topics.odometry.empty() && !came.odometry) {
    text = fmt::format("{} {}", peers.odometers == 0 ? "nobody publishes" : "no odometry came on",
                       topics.OdometryTopic());
    if (!peers.unfit_odometry.empty()) {
      text = fmt::format("what comes on {} is no odometry: {}", topics.OdometryTopic(),
                         peers.unfit_odometry);
    }
  } else if (!topics.scan.empty() && !came.scan) {
    text = fmt::format("{} {}",
                       peers.scanners == 0 ? "nobody publishes" : "no scan that can be one came on",
                       topics.ScanTopic());
  } else if (came.silent_range) {
    const std::size_t sensor = *came.silent_range;
    text = fmt::format(
        "{} {}",
        peers.rangers[sensor] == 0 ? "nobody publishes" : "no range that can be one came on",
        topics.RangeTopic(sensor));
  }
  text += MismatchIfAny(peers);
  if (peers.cameras == 0 && peers.odometers == 0 && peers.bases == 0) {
    text += ClosedIfAny(peers);
    text += fmt::format("; looked on {}", peers.tried);
  }
  return fmt::format("{} (ROS domain {}); check the robot's drivers, its namespace and domain",
                     text, topics.domain_id);
}

std::string NobodyListens(const dds::Ros2Options& topics, const dds::Ros2Driver::Peers& peers) {
  const bool plain = topics.command_type == dds::Ros2CommandType::kTwist;
  std::string text = fmt::format("nobody listens to it as {}", plain ? "Twist" : "TwistStamped");
  text += MismatchIfAny(peers);
  return text + "; check --cmd-vel-topic and --cmd-vel-type";
}

}  // namespace trailcast::agent
