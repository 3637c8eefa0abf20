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
  // So many of a segment's features at least in its picture's middle, for followers with a narrower
  // view. Not on routes without odometry: the funnel lane, by which alone they are followed, counts
  // all features alike, and those in the middle say least of where to turn.
  int middle_features = 20;
  teach::SegmentRecorderOptions recorder;
  teach::KeyViewRecorderOptions key_views;
  teach::KeyViewRecorderOptions key_views_with_odometry =
      teach::KeyViewRecorderOptions::WithOdometry();
  // Of pictures that are kept until a turn has told how the camera hangs, to be taught again if
  // that is not as `intake` has it: 45 s of driving in pictures of 640 by 480 pixels, three minutes
  // in those of 320 by 240. 0: what was handed out cannot be taken back.
  std::size_t most_kept_bytes = std::size_t{128} << 20U;
};

// The robot's turns have told that its camera hangs otherwise than it was said to.
struct TaughtAnew {
  vision::IntakeOptions intake;  // as it does hang
  std::string text;              // one line for people
};

struct TeachStep {
  std::optional<route::Segment> finished;  // a segment that ended with this frame
  int features = 0;                        // still tracked in the current segment
  double ahead_m = 0.0;                    // of the segment under way; 0 without odometry
  bool too_few_features = false;           // nothing to hold on to in this frame (dark, blank)
  bool reverse = false;                    // it is driven backwards, as followers will be
  // All segments handed out so far are void: those from the first one on come again.
  std::optional<TaughtAnew> anew;
  // Whether followers will recognise this place.
  teach::ViewWeakness weakness = teach::ViewWeakness::kNone;
};

// Frames and odometry in, segments out: vision's tracker feeding teach's segment recorder. The
// robot's turns tell whether the camera hangs as the intake has it; if it does not, the drive is
// taught again from its first frame on, while it goes on. Touches no socket, lock, disk or clock.
// Not thread-safe.
class TeachSession {
 public:
  explicit TeachSession(const TeachOptions& options = {});
  ~TeachSession();
  TeachSession(TeachSession&&) noexcept;

  // Errors: a frame of another size than the first; odometry that appears or vanishes midway; a
  // camera that hangs otherwise, told too late to teach anew.
  [[nodiscard]] Result<TeachStep> Observe(const Observation& observation);
  // Of one frame more that waits to be taught again; nothing: none does. After each Observe, so
  // that none will soon, and before Finish until none does.
  [[nodiscard]] std::optional<TeachStep> CatchUp();
  [[nodiscard]] bool catching_up() const;
  // Of the last step, counted as they were observed.
  [[nodiscard]] int frame() const { return frame_; }
  // What was taught is as the camera hangs, as far as the robot's turns tell.
  [[nodiscard]] bool turns_told() const { return !mount_; }

  // Turned on the spot since the last segment: of a teaching that ends so this is not taught.
  [[nodiscard]] double turned_rad() const;

  // The segment under way, ended at the last frame; nothing if no feature or metre is in it.
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
