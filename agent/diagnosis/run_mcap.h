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

// One frame's results, or an event between two frames.
struct RunMoment {
  std::optional<Fields> header{};  // of the run; repeated where another route begins
  std::vector<RunEvent> events{};
  std::optional<SensorTime> stamp{};  // of the frame; an event has that of the frame before
  std::optional<FrameRow> row{};
  std::optional<motion::Pose2> odometry{};
  image::GrayImage picture{};  // may be empty
  std::vector<replay::FeatureView> features{};
};

// Seconds between the pictures in a log; with 0 it has none, and no features. Cameras are slower
// than this value, so each frame has one.
inline constexpr double kEveryPicture_s = 1e-6;

// A replay's log as an MCAP file for readers and viewers. README.md lists its topics;
// idl/viewers.proto and idl/run_log.proto have their messages. It uses no disk, no clock and no
// thread.
class RunMcap {
 public:
  explicit RunMcap(double picture_every_s = kEveryPicture_s);
  void Add(const RunMoment& moment);
  void End();
  // Returns the bytes made since the last call: the first frame and events come at once, and other
  // frames by the second.
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
  std::vector<RunMoment> early_;  // before the first frame, whose time they will get
  // The path so far, with one pose each spacing_m, which grows with the path's length.
  std::vector<motion::Pose2> way_;
  double spacing_m_ = 0.05;
  std::size_t poses_since_path_ = 0;
};

}  // namespace trailcast::agent
