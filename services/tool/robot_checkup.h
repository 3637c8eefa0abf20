#pragma once

#include <vector>

#include "agent/device/robot_measures.h"
#include "services/tool/checkup.h"

namespace trailcast::tool {

// What a ROS 2 robot's measures say, and what to do about it.
[[nodiscard]] std::vector<Finding> JudgeRobot(const agent::RobotMeasures& measures,
                                              const dds::Ros2Options& topics);

// What its scanner's and range sensors' say, as far as it is said to have any.
[[nodiscard]] std::vector<Finding> JudgeObstacleSensors(const agent::RobotMeasures& measures,
                                                        const dds::Ros2Options& topics);

}  // namespace trailcast::tool
