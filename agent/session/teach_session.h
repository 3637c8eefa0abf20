#pragma once

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
};

struct TeachStep {
  std::optional<route::Segment> finished;  // a segment that ended with this frame
  int features = 0;                        // still tracked in the current segment
  bool too_few_features = false;           // nothing to hold on to in this frame (dark, blank)
  bool reverse = false;                    // it is driven backwards, as followers will be
  // Whether followers will recognise this place.
  teach::ViewWeakness weakness = teach::ViewWeakness::kNone;
};

// Frames and odometry in, segments out: vision's tracker feeding teach's segment recorder. Touches
// no socket, lock, disk or clock. Not thread-safe.
class TeachSession {
 public:
  explicit TeachSession(const TeachOptions& options = {});
  ~TeachSession();
  TeachSession(TeachSession&&) noexcept;

  // Errors: a frame of another size than the first; odometry that appears or vanishes midway.
  [[nodiscard]] Result<TeachStep> Observe(const Observation& observation);

  // Turned on the spot since the last segment: of a teaching that ends so this is not taught.
  [[nodiscard]] double turned_rad() const;

  // The segment under way, ended at the last frame; nothing if no feature or metre is in it.
  [[nodiscard]] std::optional<route::Segment> Finish();

 private:
  struct State;
  TeachOptions options_;
  FrameCheck check_;
  vision::PictureIntake intake_;
  std::unique_ptr<State> state_;  // since the first frame
};

}  // namespace trailcast::agent
