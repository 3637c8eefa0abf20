#pragma once

#include <optional>
#include <string>
#include <vector>

#include "agent/session/teach_session.h"
#include "services/base/result.h"
#include "services/lab/trial/recording/taught_frames.h"
#include "services/route/route.h"
#include "services/route/terrain_profile.h"

namespace trailcast::trial {

// A route as it is sent.
struct TaughtRoute {
  route::RouteInfo info;
  std::vector<route::SegmentPiece> pieces;
  route::TerrainProfile ground{};
};

// Teaches a route for a trial, which is never stored or sent.
class RouteRecorder {
 public:
  RouteRecorder(const std::string& name, const std::string& camera,
                const agent::TeachOptions& options);

  // Errors are TeachSession's.
  [[nodiscard]] Result<void> Observe(const agent::Observation& seen);
  // kUnavailable means that nothing was seen from which a segment could be made.
  [[nodiscard]] Result<TaughtRoute> Finish();
  // Returns the frames from which each segment was made; complete after Finish.
  [[nodiscard]] const std::vector<FrameSpan>& spans() const { return spans_; }

 private:
  void Take(const agent::TeachStep& step);
  void Keep(const std::optional<route::Segment>& segment, int last_frame);
  void SetSize(const vision::IntakeOptions& intake);

  vision::IntakeOptions intake_;
  vision::PictureSize camera_;
  agent::TeachSession session_;
  TaughtRoute taught_;
  bool has_odometry_ = false;
  std::optional<int> began_;  // the first frame of the segment under way
  std::vector<FrameSpan> spans_;
};

}  // namespace trailcast::trial
