#pragma once

#include <vector>

#include "agent/device/robot_measures.h"
#include "services/tool/checkup.h"

namespace trailcast::tool {

// Judges the measures of a ROS 2 robot, with advice.
[[nodiscard]] std::vector<Finding> JudgeRobot(const agent::RobotMeasures& measures,
                                              const dds::Ros2Options& topics);

// Judges those of its scanner and range sensors, as far as the robot is said to have any.
[[nodiscard]] std::vector<Finding> JudgeObstacleSensors(const agent::RobotMeasures& measures,
                                                        const dds::Ros2Options& topics);

}  // namespace trailcast::tool
