# The route format: C++ from route.proto. Generated code keeps its own warnings, and needs only
# Protobuf's small runtime (no reflection), which keeps robots' memory down.
set(TRAILCAST_GENERATED_DIR "${PROJECT_BINARY_DIR}/generated")
file(MAKE_DIRECTORY "${TRAILCAST_GENERATED_DIR}")
set(TRAILCAST_ROUTE_PB "${TRAILCAST_GENERATED_DIR}/idl/route.pb")
add_custom_command(
  OUTPUT "${TRAILCAST_ROUTE_PB}.cc" "${TRAILCAST_ROUTE_PB}.h"
  COMMAND protobuf::protoc "--proto_path=${PROJECT_SOURCE_DIR}"
          "--cpp_out=${TRAILCAST_GENERATED_DIR}" "${PROJECT_SOURCE_DIR}/idl/route.proto"
  DEPENDS route.proto protobuf::protoc
  COMMENT "Generating C++ from idl/route.proto"
  VERBATIM)
add_library(trailcast_route_format STATIC "${TRAILCAST_ROUTE_PB}.cc" "${TRAILCAST_ROUTE_PB}.h")
target_compile_features(trailcast_route_format PUBLIC cxx_std_20)
target_include_directories(trailcast_route_format SYSTEM PUBLIC "$<BUILD_INTERFACE:${TRAILCAST_GENERATED_DIR}>")
target_link_libraries(trailcast_route_format PUBLIC protobuf::libprotobuf-lite)
