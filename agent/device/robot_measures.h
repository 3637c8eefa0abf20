#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "agent/device/obstacle_options.h"
#include "services/base/result.h"
#include "services/dds/ros2_link.h"
#include "services/image/image.h"
#include "services/motion/cone_range.h"
#include "services/motion/motion.h"
#include "services/motion/scan.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

// How well a camera's picture suits tracking.
struct PictureMeasures {
  double brightness = 0.0;  // mean, 0..255
  double contrast = 0.0;    // standard deviation
  // The steepness of edges over one pixel, relative to four: 1 if everything changes within a
  // pixel, 0.25 if everything is blurred.
  double sharpness = 0.0;
};
[[nodiscard]] PictureMeasures MeasurePicture(const image::GrayImage& picture);

// The result of telling a robot to turn to the left for a while.
struct TurnMeasures {
  double told_rad = 0.0;
  double odometry_rad = 0.0;  // counter-clockwise positive
  // How far its features moved to the right, and down, as shares of the picture's width.
  double picture_share = 0.0;
  double picture_down_share = 0.0;
  std::optional<double> base_delay_s;  // from the command until odometry turns
  // How much later the pictures' stamps are than odometry's of the same moment, by the turns of
  // both.
  std::optional<double> stamps_late_s;
};

// A scanner's measures.
struct ScanMeasures {
  int scans = 0;
  double rate_hz = 0.0;
  // These are of the last scan.
  int ranges = 0;
  int seen = 0;          // ranges with a value
  int within_robot = 0;  // of these, those in the place of the robot itself
  Eigen::Vector2d first_within = Eigen::Vector2d::Zero();  // from the axle: x ahead, y left
};
// Measures one scan alone.
[[nodiscard]] ScanMeasures MeasureScan(const motion::Scan& scan, const ObstacleOptions& robot);

// A range sensor's measures.
struct RangeMeasures {
  int ranges = 0;
  double rate_hz = 0.0;
  motion::ConeRange last;
};

// The messages of a ROS 2 robot within a few seconds.
struct RobotMeasures {
  dds::Ros2Driver::Peers peers;
  int pictures = 0;
  double picture_rate_hz = 0.0;
  int width_px = 0;
  int height_px = 0;
  std::string unreadable;  // why pictures could not be read; empty if they could
  PictureMeasures picture;
  int odometry = 0;  // samples
  double odometry_rate_hz = 0.0;
  bool picture_stamps_stand = false;
  bool odometry_stamps_stand = false;
  // How far pictures' stamps are ahead of odometry's, by arrival. Needs both.
  std::optional<double> clocks_apart_s;
  std::optional<TurnMeasures> turn;
  ScanMeasures scan;
  std::vector<RangeMeasures> ranges;  // as many as there are range topics
};

struct MeasureOptions {
  dds::Ros2Options topics;
  vision::IntakeOptions intake;  // how the camera is mounted, as given
  ObstacleOptions obstacles;     // the robot's size, as given
  std::chrono::milliseconds look{3000};
  // Turns the robot to the left and back, for a second and a half each. The speed ahead is for
  // cars.
  bool turn = false;
  motion::VelocityCommand turn_command{0.0, 0.4};
  std::function<bool()> stop = [] { return false; };
};

// Measures a robot, which stands afterwards. Errors: the topics cannot be opened.
[[nodiscard]] Result<RobotMeasures> MeasureRobot(const MeasureOptions& options);

}  // namespace trailcast::agent
