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

// The topics of a ROS 2 robot (idl/ros2.idl), for the driver's end and the robot's own, without an
// installation of ROS. The other end may use any ROS 2 middleware over DDS.
namespace trailcast::dds {

enum class Ros2CommandType : std::uint8_t { kTwist, kTwistStamped };

struct Ros2Options {
  std::uint32_t domain_id = 0;  // ROS_DOMAIN_ID
  std::string discovery_tag;    // real ROS robots have none
  // If it is empty, the driver uses the network's interface, as DDS chooses it, and the loopback,
  // and so meets nodes with any of ROS 2's usual settings (ros2_network.h).
  std::string network_interface;
  // These are ROS names. A name without a leading '/' is below `robot`, as in "/robot1".
  std::string robot;
  std::string image = "image_raw";  // ends with "/compressed": sensor_msgs/CompressedImage
  std::string odometry = "odom";    // empty: none
  std::string scan;                 // empty: none
  std::vector<std::string> ranges;  // any number of sensors that measure in a cone
  std::string imu;                  // empty: none
  std::string battery;              // empty: none
  std::string command = "cmd_vel";
  Ros2CommandType command_type = Ros2CommandType::kTwistStamped;
  bool hear_commands = false;  // the driver also takes others' commands to the base

  // Returns "/robot1/image_raw". The others return theirs in the same way.
  [[nodiscard]] std::string ImageTopic() const;
  [[nodiscard]] std::string OdometryTopic() const;
  [[nodiscard]] std::string ScanTopic() const;
  [[nodiscard]] std::string RangeTopic(std::size_t sensor) const;
  [[nodiscard]] std::string ImuTopic() const;
  [[nodiscard]] std::string BatteryTopic() const;
  [[nodiscard]] std::string CommandTopic() const;
  [[nodiscard]] bool image_is_compressed() const;
  // kInvalidArgument names a topic name that ROS or DDS would refuse.
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
  std::size_t sensor = 0;  // index in Ros2Options::ranges
  motion::ConeRange range;
};

// sensor_msgs/Imu.
struct Ros2Imu {
  SensorTime stamp{};
  motion::ImuSample felt;
};

// sensor_msgs/BatteryState as it is sent: each of these may be NaN.
struct Ros2Battery {
  SensorTime stamp{};
  float percentage = 0.0F;
  float charge_ah = 0.0F;
  float capacity_ah = 0.0F;
};

// geometry_msgs/Twist or TwistStamped.
struct Ros2Command {
  SensorTime stamp{};  // of the frame that it answers; a Twist has none
  motion::VelocityCommand velocity;
};

using Ros2Sensed = std::variant<Ros2Image, Ros2CompressedImage, Ros2Odometry, Ros2Scan, Ros2Range,
                                Ros2Imu, Ros2Battery, Ros2Command>;

// The driver's end: it takes sensor data and sends commands. One thread may call Take while another
// calls the rest.
class Ros2Driver {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Driver>> Open(const Ros2Options& options);
  virtual ~Ros2Driver() = default;
  Ros2Driver(const Ros2Driver&) = delete;
  Ros2Driver& operator=(const Ros2Driver&) = delete;

  // Waits for data at most so long and returns what came since the last call, with pictures and
  // odometry from one publisher each. It leaves out samples with invalid numbers (NaN, a quaternion
  // of length 0), and scans and ranges that no sensor can give.
  [[nodiscard]] virtual std::vector<Ros2Sensed> Take(std::chrono::milliseconds max_wait) = 0;
  [[nodiscard]] virtual Result<void> Publish(const Ros2Command& command) = 0;

  struct Peers {
    int cameras = 0;    // publishers of the image topic
    int odometers = 0;  // publishers of the odometry topic
    int bases = 0;      // listeners to the command topic
    // The topic and the policy of a peer whose quality of service is not compatible with ours;
    // empty if there is none.
    std::string mismatch;
    std::string tried;  // for people: the network interfaces that were searched
    // For people: the participants of the domain that show no topics at all, as those with DDS
    // Security (SROS 2) do.
    std::vector<std::string> closed{};
    int scanners = 0;            // publishers of the scan topic
    std::vector<int> rangers{};  // publishers of each range topic
    int imus = 0;                // publishers of the IMU topic
    int batteries = 0;           // publishers of the battery topic
    // How many samples of odometry Take has left out.
    int unusable_odometry = 0;
    // Why the newest odometry message was left out; empty if it was not, or none came.
    std::string unfit_odometry{};
  };
  [[nodiscard]] virtual Peers peers() const = 0;
  // Returns the topic of pictures or of odometry that has several publishers at once, or an empty
  // text. Only one of them is passed on.
  [[nodiscard]] virtual std::string crowded() const { return {}; }

 protected:
  Ros2Driver() = default;
};

// The robot's end, for a virtual robot: it publishes sensor data and takes commands. It is
// single-threaded.
class Ros2Robot {
 public:
  [[nodiscard]] static Result<std::unique_ptr<Ros2Robot>> Open(const Ros2Options& options);
  ~Ros2Robot();
  Ros2Robot(const Ros2Robot&) = delete;
  Ros2Robot& operator=(const Ros2Robot&) = delete;

  [[nodiscard]] Result<void> Publish(const Ros2Image& image);
  [[nodiscard]] Result<void> Publish(const Ros2Odometry& odometry);
  // Needs a scan topic.
  [[nodiscard]] Result<void> Publish(const Ros2Scan& scan);
  // Needs the sensor's range topic.
  [[nodiscard]] Result<void> Publish(const Ros2Range& range);
  // Needs an IMU topic.
  [[nodiscard]] Result<void> Publish(const Ros2Imu& imu);
  // Needs a battery topic.
  [[nodiscard]] Result<void> Publish(const Ros2Battery& battery);
  // Waits for a command at most so long and returns the latest one that came since the last call.
  [[nodiscard]] std::optional<Ros2Command> Take(std::chrono::milliseconds max_wait);
  // Says whether anybody subscribes to its pictures.
  [[nodiscard]] bool watched() const;
  [[nodiscard]] bool scan_is_heard() const;  // likewise for its scans
  [[nodiscard]] bool range_is_heard(std::size_t sensor) const;
  [[nodiscard]] bool imu_is_heard() const;

 private:
  struct State;
  explicit Ros2Robot(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::dds
