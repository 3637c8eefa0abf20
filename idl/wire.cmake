# The DDS types, generated as C and compiled as C, outside our warnings.
# Users include "trailcast.h".
idlc_generate(TARGET trailcast_wire_types_generated FILES "${CMAKE_CURRENT_LIST_DIR}/trailcast.idl")
add_library(trailcast_wire_types STATIC)
# PRIVATE: the generated target's sources must not be compiled again by each user.
target_link_libraries(
  trailcast_wire_types
  PRIVATE $<BUILD_INTERFACE:trailcast_wire_types_generated>
  PUBLIC CycloneDDS::ddsc)
target_include_directories(trailcast_wire_types SYSTEM INTERFACE "$<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>")
