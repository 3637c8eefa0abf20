#pragma once

namespace trailcast::test {

// These are empty if the programs are not built.
inline constexpr const char* kFastDdsPeer = TRAILCAST_FAST_DDS_PEER;
inline constexpr const char* kFastDdsRobot = TRAILCAST_FAST_DDS_ROBOT;

inline constexpr const char* kNoFastDds =
    "built without fastddsgen, java or libfastrtps-dev (config/setup/install.sh check installs "
    "them)";

}  // namespace trailcast::test
