#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "agent/diagnosis/run_log.h"
#include "services/base/time.h"
#include "services/motion/motion.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// Where the log as text is in a log as MCAP.
inline constexpr const char* kRunLogTopic = "/replay/log";
inline constexpr const char* kPicturesTopic = "/camera/image";
inline constexpr const char* kFeaturesTopic = "/camera/features";
// Text packs to a tenth or so: what unpacks to more than this was made to keep its readers busy.
inline constexpr std::uint64_t kMostGrowth = 32;

// The messages of idl/viewers.proto and idl/run_log.proto, as bytes.
[[nodiscard]] std::string PictureMessage(SensorTime at, std::span<const std::uint8_t> jpeg);
// A disc a feature, and a line to where it will be at the milestone, in its verdict's colour; of a
// rejected one to where it should be. On a picture of that size.
[[nodiscard]] std::string FeaturesMessage(SensorTime at,
                                          std::span<const replay::FeatureView> features, int width,
                                          int height);
[[nodiscard]] std::string PoseMessage(SensorTime at, const motion::Pose2& pose);
[[nodiscard]] std::string PathMessage(SensorTime at, std::span<const motion::Pose2> poses);
[[nodiscard]] std::string StateMessage(SensorTime at, const RunEvent& event);
[[nodiscard]] std::string FrameMessage(const FrameRow& row);
[[nodiscard]] std::string TextMessage(std::string_view text);

// Nothing: bytes that are no such message.
[[nodiscard]] std::optional<std::string_view> ReadTextMessage(std::span<const std::uint8_t> bytes);

// Whether that is how it begins; the stream is at its beginning again.
[[nodiscard]] bool IsMcap(std::istream& stream);

}  // namespace trailcast::agent
