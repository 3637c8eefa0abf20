#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "agent/session/observation.h"
#include "agent/session/place_finder.h"
#include "agent/session/replay_method.h"
#include "agent/session/replay_step.h"
#include "services/base/result.h"
#include "services/refresh/visit.h"
#include "services/replay/feature_view.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This takes frames and odometry, and returns velocity commands: vision's tracker and finder feed
// replay's follower. Segments may be added while driving. It touches no socket, lock, disk or
// clock.
class ReplaySession {
 public:
  // `route` gives the size of the scout's frames (vision::WorkingSize). Its segment_count and state
  // are not used.
  ReplaySession(const ReplayMethodOptions& options, const route::RouteInfo& route);
  ~ReplaySession();
  ReplaySession(ReplaySession&&) noexcept;
  ReplaySession& operator=(ReplaySession&&) noexcept;

  // Adds segments in order from index 0, and returns kInvalidArgument otherwise.
  [[nodiscard]] Result<void> AddSegment(route::Segment segment);
  // The last segment added is the route's last.
  void MarkComplete();
  // Says before the first frame that the robot may be where an earlier run has left it. It stands
  // until it has found itself there, or at the route's start, and is kLost if it is at neither.
  void GoOnFrom(const LeftAt& left);
  // Returns the metres of the route that are known.
  [[nodiscard]] double known_m() const;

  // A robot whose camera gives an empty frame, or one of another size than the first, stands, and
  // the step has the reason. It is an error if odometry appears or vanishes midway.
  [[nodiscard]] Result<ReplayStep> Observe(const Observation& observation);

  // Passes a frame that a robot which stands need not examine, for observers of the run.
  void Pass(const Observation& observation);

  // Returns once what a run met, to refresh the route by, if the run has arrived and was to take
  // experience.
  [[nodiscard]] std::optional<refresh::Visit> TakeVisit();

  // Returns what the run has learnt of the robot's camera, for the next one.
  [[nodiscard]] std::optional<OwnLens> lens() const;

  // Returns the last frame that was observed or passed, as the intake makes it. It is valid until
  // the next frame and as long as that frame is, and null before the first.
  [[nodiscard]] const image::GrayImage* picture() const;
  // Returns the features as of `step`, the last one that Observe returned, for drawing. A frame
  // that was passed has none.
  [[nodiscard]] std::vector<replay::FeatureView> ViewFeatures(const ReplayStep& step) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
