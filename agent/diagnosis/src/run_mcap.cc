#include "agent/diagnosis/run_mcap.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/diagnosis/src/run_log_messages.h"
#include "agent/diagnosis/src/viewer_messages.h"
#include "idl/run_log_description.h"
#include "services/image/files.h"

namespace trailcast::agent {
namespace {

constexpr int kJpegQuality = 85;
// A program that crashes loses at most this.
constexpr std::chrono::seconds kChunk{1};
constexpr std::size_t kMostOfTheWay = 512;
// The path so far is written this often.
constexpr std::size_t kPosesAPath = 16;

}  // namespace

RunMcap::RunMcap(double picture_every_s)
    : picture_every_s_(picture_every_s),
      writer_(bag::Compression::kZstd, ""),
      picture_(AddTopic(kPicturesTopic, "foxglove.CompressedImage")),
      features_(AddTopic(kFeaturesTopic, "foxglove.ImageAnnotations")),
      pose_(AddTopic("/odometry/pose", "foxglove.PoseInFrame")),
      path_(AddTopic("/odometry/path", "foxglove.PosesInFrame")),
      states_(AddTopic("/replay/states", "foxglove.Log")),
      frame_(AddTopic(kFrameTopic, "trailcast.log.Frame")),
      header_(AddTopic(kHeaderTopic, "trailcast.log.Header")),
      event_(AddTopic(kEventTopic, "trailcast.log.Event")) {}

RunMcap::Channel RunMcap::AddTopic(const char* topic, const char* message) {
  const auto schema = writer_.AddSchema(message, "protobuf", RunLogDescription());
  return writer_.AddChannel(schema, topic, "protobuf");
}

void RunMcap::Put(Channel channel, const std::string& message) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(message.data());
  writer_.Put(channel, at_, {bytes, message.size()});
}

void RunMcap::PutPicture(const RunMoment& moment) {
  const bool due = !pictured_at_ || std::abs(Seconds(at_ - *pictured_at_)) >= picture_every_s_;
  if (due) {
    const auto jpeg = image::EncodeJpeg(moment.picture, kJpegQuality);
    if (!jpeg) return;
    Put(picture_, PictureMessage(at_, *jpeg));
    pictured_at_ = at_;
  }
  Put(features_,
      FeaturesMessage(at_, moment.features, moment.picture.width, moment.picture.height));
}

void RunMcap::PutPose(const motion::Pose2& pose) {
  Put(pose_, PoseMessage(at_, pose));
  if (!way_.empty()) {
    const double driven_m = (motion::Position(pose) - motion::Position(way_.back())).norm();
    if (driven_m < spacing_m_) return;
  }
  way_.push_back(pose);
  if (way_.size() > kMostOfTheWay) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < way_.size(); i += 2) way_[kept++] = way_[i];
    way_.resize(kept);
    spacing_m_ *= 2.0;
  }
  if (++poses_since_path_ >= kPosesAPath) PutPath();
}

void RunMcap::PutPath() {
  if (poses_since_path_ == 0) return;
  poses_since_path_ = 0;
  Put(path_, PathMessage(at_, way_));
}

void RunMcap::PutWords(const RunMoment& moment) {
  if (moment.header) Put(header_, HeaderMessage(*moment.header));
  for (const RunEvent& event : moment.events) {
    Put(states_, StateMessage(at_, event));
    Put(event_, EventMessage(event));
  }
}

void RunMcap::Add(const RunMoment& moment) {
  if (!moment.stamp && !chunk_began_) {
    early_.push_back(moment);
    return;
  }
  if (moment.stamp) at_ = std::max(*moment.stamp, SensorTime(0));
  const bool first = !chunk_began_;
  if (first || std::chrono::abs(at_ - *chunk_began_) >= kChunk) {
    writer_.EndChunk();
    chunk_began_ = at_;
  }
  for (const RunMoment& early : std::exchange(early_, {})) PutWords(early);
  if (picture_every_s_ > 0.0 && !moment.picture.empty()) PutPicture(moment);
  if (moment.odometry) PutPose(*moment.odometry);
  if (moment.row) Put(frame_, FrameMessage(*moment.row));
  PutWords(moment);
  if (first || !moment.stamp) writer_.EndChunk();
}

void RunMcap::End() {
  PutPath();
  for (const RunMoment& early : std::exchange(early_, {})) PutWords(early);
  writer_.End();
}

}  // namespace trailcast::agent
