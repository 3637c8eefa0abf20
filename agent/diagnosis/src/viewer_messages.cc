#include "agent/diagnosis/src/viewer_messages.h"

#include <cmath>

#include "agent/diagnosis/src/frame_view.h"
#include "agent/diagnosis/src/protobuf_writer.h"

namespace trailcast::agent {
namespace {

constexpr std::uint64_t kLineList = 4;
constexpr double kDisc_px = 5.0;
constexpr std::uint64_t kDebug = 1;
constexpr std::uint64_t kInfo = 2;
constexpr std::uint64_t kWarning = 3;
constexpr std::uint64_t kError = 4;

// All of them have a google.protobuf.Timestamp in field 1. `at` must not be negative.
ProtobufWriter Stamped(SensorTime at) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(at);
  ProtobufWriter timestamp;
  timestamp.Number(1, static_cast<std::uint64_t>(seconds.count()));
  timestamp.Number(2, static_cast<std::uint64_t>((at - seconds).count()));
  return ProtobufWriter().Message(1, timestamp);
}

ProtobufWriter PointAt(double x, double y) { return ProtobufWriter().Double(1, x).Double(2, y); }

ProtobufWriter ColorOf(replay::FeatureVerdict verdict) {
  const image::Color color = VerdictColor(verdict);
  return ProtobufWriter()
      .Double(1, color[0] / 255.0)
      .Double(2, color[1] / 255.0)
      .Double(3, color[2] / 255.0)
      .Double(4, 1.0);
}

ProtobufWriter PoseOf(const motion::Pose2& pose) {
  ProtobufWriter orientation;
  orientation.Double(3, std::sin(pose.heading_rad / 2)).Double(4, std::cos(pose.heading_rad / 2));
  return ProtobufWriter().Message(1, PointAt(pose.x_m, pose.y_m)).Message(2, orientation);
}

std::uint64_t LevelOf(const RunEvent& event) {
  if (event.what == "end") return event.fields.Find("state") == "ARRIVED" ? kInfo : kError;
  if (event.what == "carried" || event.what == "dropped") return kWarning;
  if (event.what != "phase") return event.text.empty() ? kDebug : kInfo;
  const auto phase = ParsePhase(event.fields.Find("to").value_or(""));
  if (phase == Phase::kLost) return kError;
  const bool well = phase == Phase::kSure || phase == Phase::kArrived || phase == Phase::kWaiting;
  return well ? kInfo : kWarning;
}

}  // namespace

std::string PictureMessage(SensorTime at, std::span<const std::uint8_t> jpeg) {
  return Stamped(at)
      .Bytes(2, {reinterpret_cast<const char*>(jpeg.data()), jpeg.size()})
      .Bytes(3, "jpeg")
      .Bytes(4, "camera")
      .bytes();
}

std::string FeaturesMessage(SensorTime at, std::span<const replay::FeatureView> features, int width,
                            int height) {
  const auto place = [&](const route::TrackedFeature& feature) {
    return PointAt(feature.u_px + 0.5 * width, feature.v_px + 0.5 * height);
  };
  ProtobufWriter annotations;
  ProtobufWriter lines = Stamped(at);
  lines.Number(2, kLineList);
  for (const replay::FeatureView& feature : features) {
    const ProtobufWriter color = ColorOf(feature.verdict);
    ProtobufWriter disc = Stamped(at);
    disc.Message(2, place(feature.at)).Double(3, kDisc_px).Double(4, 1.0);
    annotations.Message(1, disc.Message(5, color).Message(6, color));
    const bool rejected = feature.verdict == replay::FeatureVerdict::kRejected;
    lines.Message(3, place(feature.at));
    lines.Message(3, place(rejected ? feature.expected : feature.milestone));
    lines.Message(5, color);
  }
  return annotations.Message(2, lines.Double(7, 1.0)).bytes();
}

std::string PoseMessage(SensorTime at, const motion::Pose2& pose) {
  return Stamped(at).Bytes(2, "odom").Message(3, PoseOf(pose)).bytes();
}

std::string PathMessage(SensorTime at, std::span<const motion::Pose2> poses) {
  ProtobufWriter path = Stamped(at);
  path.Bytes(2, "odom");
  for (const motion::Pose2& pose : poses) path.Message(3, PoseOf(pose));
  return path.bytes();
}

std::string StateMessage(SensorTime at, const RunEvent& event) {
  return Stamped(at)
      .Number(2, LevelOf(event))
      .Bytes(3, DescribeEvent(event))
      .Bytes(4, "trailcast")
      .bytes();
}

}  // namespace trailcast::agent
