#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "agent/diagnosis/run_log.h"
#include "services/base/time.h"
#include "services/motion/motion.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

inline constexpr const char* kPicturesTopic = "/camera/image";
inline constexpr const char* kFeaturesTopic = "/camera/features";

// These return the messages of idl/viewers.proto as bytes.
[[nodiscard]] std::string PictureMessage(SensorTime at, std::span<const std::uint8_t> jpeg);
// Has a disc for each feature, and a line in its verdict's colour to where it will be at the
// milestone, or for a rejected one to where it should be, on a picture of that size.
[[nodiscard]] std::string FeaturesMessage(SensorTime at,
                                          std::span<const replay::FeatureView> features, int width,
                                          int height);
[[nodiscard]] std::string PoseMessage(SensorTime at, const motion::Pose2& pose);
[[nodiscard]] std::string PathMessage(SensorTime at, std::span<const motion::Pose2> poses);
[[nodiscard]] std::string StateMessage(SensorTime at, const RunEvent& event);

}  // namespace trailcast::agent
