#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/diagnosis/run_log.h"
#include "services/bag/mcap_writer.h"
#include "services/base/time.h"
#include "services/image/image.h"
#include "services/motion/motion.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// What became of one frame, or a word between two.
struct RunMoment {
  std::string text;  // as in the log as text
  std::vector<RunEvent> events{};
  std::optional<SensorTime> stamp{};  // of a frame; a word has that of the frame before
  std::optional<FrameRow> row{};
  std::optional<motion::Pose2> odometry{};
  image::GrayImage picture{};  // empty: none
  std::vector<replay::FeatureView> features{};
};

// A replay's log as MCAP, for viewers: README.md lists its topics, idl/viewers.proto and
// idl/run_log.proto their messages. No disk, no clock, no thread.
class RunMcap {
 public:
  // Seconds between the pictures that are kept; 0: all of them.
  explicit RunMcap(double picture_every_s = 0.0);
  void Add(const RunMoment& moment);
  void End();
  // What has been made since the last time: a second at once.
  [[nodiscard]] bag::Bytes TakeBytes() { return writer_.TakeBytes(); }

 private:
  using Channel = bag::McapWriter::Id;

  [[nodiscard]] Channel AddTopic(const char* topic, const char* message);
  void Put(Channel channel, const std::string& message);
  void PutPicture(const RunMoment& moment);
  void PutPose(const motion::Pose2& pose);
  void PutPath();

  const double picture_every_s_;
  bag::McapWriter writer_;
  Channel picture_;
  Channel features_;
  Channel pose_;
  Channel path_;
  Channel states_;
  Channel frame_;
  Channel text_;
  SensorTime at_{0};
  std::optional<SensorTime> chunk_began_;
  std::optional<SensorTime> pictured_at_;
  std::string early_text_;  // before the first frame
  // The way so far: not a pose a frame, but one each spacing_m_, which grows with the way.
  std::vector<motion::Pose2> way_;
  double spacing_m_ = 0.05;
  std::size_t poses_since_path_ = 0;
};

}  // namespace trailcast::agent
