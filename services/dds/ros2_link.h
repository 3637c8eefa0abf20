#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "services/base/result.h"
#include "services/base/time.h"
#include "services/motion/cone_range.h"
#include "services/motion/imu.h"
#include "services/motion/motion.h"
#include "services/motion/scan.h"

// The topics of a ROS 2 robot (idl/ros2.idl), with no ROS installed: the driver's end, and the
// robot's own. Any ROS 2 middleware over DDS may be at the other end.
namespace trailcast::dds {

enum class Ros2CommandType : std::uint8_t { kTwist, kTwistStamped };

struct Ros2Options {
  std::uint32_t domain_id = 0;  // ROS_DOMAIN_ID
  std::string discovery_tag;    // real ROS robots have none
  // Empty: the driver looks on the network's interface, as DDS chooses it, and on the loopback, and
  // meets nodes under any of ROS 2's usual settings (ros2_network.h).
  std::string network_interface;
  // ROS names; those without a '/' in front are below `robot`, as in "/robot1".
  std::string robot;
  std::string image = "image_raw";  // ends with "/compressed": sensor_msgs/CompressedImage
  std::string odometry = "odom";    // empty: none
  std::string scan;                 // empty: none
  std::vector<std::string> ranges;  // sensors that measure in a cone, any number
  std::string imu;                  // empty: none
  std::string battery;              // empty: none
  std::string command = "cmd_vel";
  Ros2CommandType command_type = Ros2CommandType::kTwistStamped;
  bool hear_commands = false;  // the driver takes what others tell the base, too

  // "/robot1/image_raw". The others in the same way.
  [[nodiscard]] std::string ImageTopic() const;
  [[nodiscard]] std::string OdometryTopic() const;
  [[nodiscard]] std::string ScanTopic() const;
  [[nodiscard]] std::string RangeTopic(std::size_t sensor) const;
  [[nodiscard]] std::string ImuTopic() const;
  [[nodiscard]] std::string BatteryTopic() const;
  [[nodiscard]] std::string CommandTopic() const;
  [[nodiscard]] bool image_is_compressed() const;
  // kInvalidArgument for a topic name that ROS or DDS would refuse.
  [[nodiscard]] Result<void> Validate() const;
};

// sensor_msgs/Image.
struct Ros2Image {
  SensorTime stamp{};
  std::uint32_t width_px = 0;
  std::uint32_t height_px = 0;
  std::string encoding;  // as sensor_msgs/image_encodings names them
  bool big_endian = false;
  std::uint32_t step = 0;  // bytes in a row
  std::vector<std::uint8_t> data;
};

// sensor_msgs/CompressedImage.
struct Ros2CompressedImage {
  SensorTime stamp{};
  std::string format;
  std::vector<std::uint8_t> data;
};

// nav_msgs/Odometry, as far as a robot on the ground needs it.
struct Ros2Odometry {
  SensorTime stamp{};
  motion::Pose2 pose;  // in the odometry's own frame
};

// sensor_msgs/LaserScan.
struct Ros2Scan {
  SensorTime stamp{};
  motion::Scan scan;
};

// sensor_msgs/Range.
struct Ros2Range {
  SensorTime stamp{};
  std::size_t sensor = 0;  // of Ros2Options::ranges
  motion::ConeRange range;
};

// sensor_msgs/Imu.
struct Ros2Imu {
  SensorTime stamp{};
  motion::ImuSample felt;
};

// sensor_msgs/BatteryState, as it is said: any of these may be no number.
struct Ros2Battery {
  SensorTime stamp{};
  float percentage = 0.0F;
  float charge_ah = 0.0F;
  float capacity_ah = 0.0F;
};

// geometry_msgs/Twist or TwistStamped.
struct Ros2Command {
  SensorTime stamp{};  // of the frame that it answers; Twist has none
  motion::VelocityCommand velocity;
};

using Ros2Sensed = std::variant<Ros2Image, Ros2CompressedImage, Ros2Odometry, Ros2Scan, Ros2Range,
                                Ros2Imu, Ros2Battery, Ros2Command>;

// Who drives the robot: senses and commands. One thread may Take while another calls the rest.
class Ros2Driver {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Driver>> Open(const Ros2Options& options);
  virtual ~Ros2Driver() = default;
  Ros2Driver(const Ros2Driver&) = delete;
  Ros2Driver& operator=(const Ros2Driver&) = delete;

  // What came since, after waiting for something at most so long; pictures and odometry of one
  // publisher each. Samples whose numbers are none
  // (NaN, a quaternion of length 0) are left out, and scans and ranges that can be no sensor's.
  [[nodiscard]] virtual std::vector<Ros2Sensed> Take(std::chrono::milliseconds max_wait) = 0;
  [[nodiscard]] virtual Result<void> Publish(const Ros2Command& command) = 0;

  struct Peers {
    int cameras = 0;    // who publishes the image topic
    int odometers = 0;  // who publishes the odometry topic
    int bases = 0;      // who listens to the command topic
    // A peer of one of the topics is there, but its quality of service does not go with ours:
    // which topic, and what policy. Empty: none.
    std::string mismatch;
    std::string tried;           // on which network interfaces they are sought, for people
    int scanners = 0;            // who publishes the scan topic
    std::vector<int> rangers{};  // who publishes each of the range topics
    int imus = 0;                // who publishes the IMU topic
    int batteries = 0;           // who publishes the battery topic
    // Samples of odometry so far that Take left out.
    int unusable_odometry = 0;
    // Why the newest message of odometry was left out. Empty: it was not, or none came.
    std::string unfit_odometry{};
  };
  [[nodiscard]] virtual Peers peers() const = 0;
  // The topic of pictures or of odometry that several publish at once; empty: neither. One of them
  // alone is passed on.
  [[nodiscard]] virtual std::string crowded() const { return {}; }

 protected:
  Ros2Driver() = default;
};

// The robot's end, for a virtual one: publishes what it senses, hears what it shall do.
// Single-threaded.
class Ros2Robot {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Robot>> Open(const Ros2Options& options);
  ~Ros2Robot();
  Ros2Robot(const Ros2Robot&) = delete;
  Ros2Robot& operator=(const Ros2Robot&) = delete;

  [[nodiscard]] Result<void> Publish(const Ros2Image& image);
  [[nodiscard]] Result<void> Publish(const Ros2Odometry& odometry);
  // If there is a scan topic.
  [[nodiscard]] Result<void> Publish(const Ros2Scan& scan);
  // If there is that range topic.
  [[nodiscard]] Result<void> Publish(const Ros2Range& range);
  // If there is an IMU topic.
  [[nodiscard]] Result<void> Publish(const Ros2Imu& imu);
  // If there is a battery topic.
  [[nodiscard]] Result<void> Publish(const Ros2Battery& battery);
  // The latest command that came since, if any, after waiting for one at most so long.
  [[nodiscard]] std::optional<Ros2Command> Take(std::chrono::milliseconds max_wait);
  // Whether somebody is there to look at its pictures.
  [[nodiscard]] bool watched() const;
  [[nodiscard]] bool scan_is_heard() const;  // the same of its scans
  [[nodiscard]] bool range_is_heard(std::size_t sensor) const;
  [[nodiscard]] bool imu_is_heard() const;

 private:
  struct State;
  explicit Ros2Robot(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::dds
