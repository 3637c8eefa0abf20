# A replay's log: no code of run_log.proto and viewers.proto, but their description, which
# each such file carries. Users include "idl/run_log_description.h".
set(description "${TRAILCAST_GENERATED_DIR}/idl/run_log_description")
set(protos "${PROJECT_SOURCE_DIR}/idl/run_log.proto" "${PROJECT_SOURCE_DIR}/idl/viewers.proto")
add_custom_command(
  OUTPUT "${description}.cc"
  COMMAND protobuf::protoc "--proto_path=${PROJECT_SOURCE_DIR}" --include_imports
          "--descriptor_set_out=${description}.bin" ${protos}
  COMMAND "${CMAKE_COMMAND}" "-DFROM=${description}.bin" "-DTO=${description}.cc" -P
          "${CMAKE_CURRENT_LIST_DIR}/embed.cmake"
  DEPENDS ${protos} "${CMAKE_CURRENT_LIST_DIR}/embed.cmake" protobuf::protoc
  COMMENT "Describing a replay's log"
  VERBATIM)
add_library(trailcast_run_log_description STATIC "${description}.cc")
trailcast_target_defaults(trailcast_run_log_description)
