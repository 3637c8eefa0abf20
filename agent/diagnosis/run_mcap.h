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
  std::optional<Fields> header{};  // of the run; again where another route begins
  std::vector<RunEvent> events{};
  std::optional<SensorTime> stamp{};  // of a frame; a word has that of the frame before
  std::optional<FrameRow> row{};
  std::optional<motion::Pose2> odometry{};
  image::GrayImage picture{};  // empty: none
  std::vector<replay::FeatureView> features{};
};

// Seconds between the pictures in a log; 0: it has none, and no features. Cameras are slower than
// this: each frame has one.
inline constexpr double kEveryPicture_s = 1e-6;

// A replay's log, an MCAP file for readers and viewers: README.md lists its topics,
// idl/viewers.proto and idl/run_log.proto their messages. No disk, no clock, no thread.
class RunMcap {
 public:
  explicit RunMcap(double picture_every_s = kEveryPicture_s);
  void Add(const RunMoment& moment);
  void End();
  // Returns what has been made since the last time: the first frame and what is said between frames
  // come at once, other frames by the second.
  [[nodiscard]] bag::Bytes TakeBytes() { return writer_.TakeBytes(); }

 private:
  using Channel = bag::McapWriter::Id;

  [[nodiscard]] Channel AddTopic(const char* topic, const char* message);
  void Put(Channel channel, const std::string& message);
  void PutWords(const RunMoment& moment);
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
  Channel header_;
  Channel event_;
  SensorTime at_{0};
  std::optional<SensorTime> chunk_began_;
  std::optional<SensorTime> pictured_at_;
  std::vector<RunMoment> early_;  // before the first frame, whose time they will have
  // The way so far: not a pose a frame, but one each spacing_m_, which grows with the way.
  std::vector<motion::Pose2> way_;
  double spacing_m_ = 0.05;
  std::size_t poses_since_path_ = 0;
};

}  // namespace trailcast::agent
