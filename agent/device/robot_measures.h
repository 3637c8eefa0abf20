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

// How well a camera's picture can be held on to.
struct PictureMeasures {
  double brightness = 0.0;  // mean, 0..255
  double contrast = 0.0;    // standard deviation
  // How steep edges are over one pixel, as a share of how they are over four: 1 where all changes
  // within a pixel, 0.25 where all is blurred.
  double sharpness = 0.0;
};
[[nodiscard]] PictureMeasures MeasurePicture(const image::GrayImage& picture);

// What became of a robot that was told to turn to the left for a while.
struct TurnMeasures {
  double told_rad = 0.0;
  double odometry_rad = 0.0;  // counter-clockwise positive
  // How far its features moved to the right, and down, of the picture's width.
  double picture_share = 0.0;
  double picture_down_share = 0.0;
  std::optional<double> base_delay_s;  // from the command until odometry turns
  // The pictures' stamps, later than odometry's of the same moment, by how both turn.
  std::optional<double> stamps_late_s;
};

// What a scanner sees.
struct ScanMeasures {
  int scans = 0;
  double rate_hz = 0.0;
  // Of the last scan.
  int ranges = 0;
  int seen = 0;          // that measure something
  int within_robot = 0;  // of these, whose place the robot itself fills
  Eigen::Vector2d first_within = Eigen::Vector2d::Zero();  // from the axle: x ahead, y left
};
// Of one scan alone.
[[nodiscard]] ScanMeasures MeasureScan(const motion::Scan& scan, const ObstacleOptions& robot);

// What a range sensor sees.
struct RangeMeasures {
  int ranges = 0;
  double rate_hz = 0.0;
  motion::ConeRange last;
};

// What a ROS 2 robot says within a few seconds.
struct RobotMeasures {
  dds::Ros2Driver::Peers peers;
  int pictures = 0;
  double picture_rate_hz = 0.0;
  int width_px = 0;
  int height_px = 0;
  std::string unreadable;  // why pictures could not be read; empty: they could
  PictureMeasures picture;
  int odometry = 0;  // samples
  double odometry_rate_hz = 0.0;
  bool picture_stamps_stand = false;
  bool odometry_stamps_stand = false;
  // By when they come: pictures' stamps, ahead of odometry's. With both.
  std::optional<double> clocks_apart_s;
  std::optional<TurnMeasures> turn;
  ScanMeasures scan;
  std::vector<RangeMeasures> ranges;  // as many as there are range topics
};

struct MeasureOptions {
  dds::Ros2Options topics;
  vision::IntakeOptions intake;  // how the camera is said to be mounted
  ObstacleOptions obstacles;     // how large the robot is said to be
  std::chrono::milliseconds look{3000};
  // Turns the robot to the left and back, a second and a half each; the speed ahead is for cars.
  bool turn = false;
  motion::VelocityCommand turn_command{0.0, 0.4};
  std::function<bool()> stop = [] { return false; };
};

// The robot stands afterwards. Errors: the topics cannot be opened.
[[nodiscard]] Result<RobotMeasures> MeasureRobot(const MeasureOptions& options);

}  // namespace trailcast::agent
