#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "agent/session/frame_check.h"
#include "agent/session/observation.h"
#include "services/base/result.h"
#include "services/route/route.h"
#include "services/teach/key_view_recorder.h"
#include "services/teach/segment_recorder.h"
#include "services/vision/feature_tracker.h"
#include "services/vision/picture_intake.h"

namespace trailcast::agent {

struct TeachOptions {
  vision::IntakeOptions intake;
  vision::FeatureTrackerOptions features;
  // A segment has at least this many features in the middle of its picture, for followers with a
  // narrower view. This does not hold on routes without odometry: the funnel lane, the only way to
  // follow them, counts all features alike, and those in the middle tell least of where to turn.
  int middle_features = 20;
  teach::SegmentRecorderOptions recorder;
  teach::KeyViewRecorderOptions key_views;
  teach::KeyViewRecorderOptions key_views_with_odometry =
      teach::KeyViewRecorderOptions::WithOdometry();
  // This bounds the pictures that are kept until a turn has told how the camera is mounted, to be
  // taught again if that is not as `intake` says: 45 s of driving in pictures of 640 by 480 pixels,
  // three minutes in those of 320 by 240. With 0 nothing that was handed out can be taken back.
  std::size_t most_kept_bytes = std::size_t{128} << 20U;
};

// The robot's turns have told that its camera is mounted otherwise than stated.
struct TaughtAnew {
  vision::IntakeOptions intake;  // as it is mounted
  std::string text;              // one line for people
};

struct TeachStep {
  std::optional<route::Segment> finished;  // a segment that ended with this frame
  int features = 0;                        // still tracked in the current segment
  double ahead_m = 0.0;                    // length of the present segment; 0 without odometry
  bool too_few_features = false;           // the frame is too dark or blank to track anything
  bool reverse = false;                    // the robot drives backwards, as followers will
  // All segments handed out so far are void, and come again from the first one on.
  std::optional<TaughtAnew> anew;
  // This tells whether followers will recognise this place.
  teach::ViewWeakness weakness = teach::ViewWeakness::kNone;
};

// This takes frames and odometry, and returns segments: vision's tracker feeds teach's segment
// recorder. The robot's turns tell whether the camera is mounted as the intake says. If it is not,
// the drive is taught again from its first frame on, while it goes on. It touches no socket, lock,
// disk or clock, and is not thread-safe.
class TeachSession {
 public:
  explicit TeachSession(const TeachOptions& options = {});
  ~TeachSession();
  TeachSession(TeachSession&&) noexcept;

  // It is an error if a frame has another size than the first, if odometry appears or vanishes
  // midway, or if the camera is found to be mounted otherwise too late to teach anew.
  [[nodiscard]] Result<TeachStep> Observe(const Observation& observation);
  // Teaches one more frame that waits to be taught again, or returns nothing if none does. Call it
  // after each Observe, so that the queue empties, and before Finish until it is empty.
  [[nodiscard]] std::optional<TeachStep> CatchUp();
  [[nodiscard]] bool catching_up() const;
  // This is the last step's frame, in the order of observation.
  [[nodiscard]] int frame() const { return frame_; }
  // Tells that what was taught fits the camera's mount, as far as the robot's turns tell.
  [[nodiscard]] bool turns_told() const { return !mount_; }

  // Returns the turn on the spot since the last segment. A teaching that ends so does not include
  // it.
  [[nodiscard]] double turned_rad() const;

  // Returns the present segment, ended at the last frame, or nothing if no feature or metre is in
  // it.
  [[nodiscard]] std::optional<route::Segment> Finish();

 private:
  struct State;
  struct Mount;
  struct Waiting;
  [[nodiscard]] TeachStep Take(const Observation& observation);
  [[nodiscard]] Result<std::optional<TaughtAnew>> LookAtMount(const Observation& observation);

  TeachOptions options_;
  FrameCheck check_;
  vision::PictureIntake intake_;
  std::unique_ptr<State> state_;  // since the first frame
  std::unique_ptr<Mount> mount_;  // until a turn has told
  std::unique_ptr<Waiting> waiting_;
  int observed_ = 0;
  int frame_ = -1;
};

}  // namespace trailcast::agent
