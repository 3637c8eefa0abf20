# The topics of ROS 2 robots, generated as C and compiled as C. Users include "ros2.h".
idlc_generate(TARGET trailcast_ros2_types_generated NO_TYPE_INFO FILES
              "${CMAKE_CURRENT_LIST_DIR}/ros2.idl")
add_library(trailcast_ros2_types STATIC)
target_link_libraries(
  trailcast_ros2_types
  PRIVATE $<BUILD_INTERFACE:trailcast_ros2_types_generated>
  PUBLIC CycloneDDS::ddsc)
target_include_directories(trailcast_ros2_types SYSTEM INTERFACE "$<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>")
