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

// Frames and odometry in, velocity commands out: vision's tracker and finder feeding replay's
// follower. Segments may be added while driving. Touches no socket, lock, disk or clock.
class ReplaySession {
 public:
  // `route` gives the size of the scout's frames (vision::WorkingSize); its segment_count and state
  // are not looked at.
  ReplaySession(const ReplayMethodOptions& options, const route::RouteInfo& route);
  ~ReplaySession();
  ReplaySession(ReplaySession&&) noexcept;
  ReplaySession& operator=(ReplaySession&&) noexcept;

  // In order from index 0; kInvalidArgument otherwise.
  [[nodiscard]] Result<void> AddSegment(route::Segment segment);
  // The last segment added is the route's last.
  void MarkComplete();
  // Before the first frame: the robot may be where an earlier run has left it. It stands until it
  // has found itself there, or at the route's start, and is kLost if it is at neither.
  void GoOnFrom(const LeftAt& left);
  // Metres of the route that are known.
  [[nodiscard]] double known_m() const;

  // A robot whose camera gives an empty frame, or one of another size than the first, stands and is
  // told why. Error: odometry that appears or vanishes midway.
  [[nodiscard]] Result<ReplayStep> Observe(const Observation& observation);

  // A frame that a robot which stands need not look at, for those who look on.
  void Pass(const Observation& observation);

  // Of a run that has arrived, and was to take experience: what it met with, to refresh the route
  // by. Once; nothing otherwise.
  [[nodiscard]] std::optional<refresh::Visit> TakeVisit();

  // What the run has learnt of the robot's camera, for the next one.
  [[nodiscard]] std::optional<OwnLens> lens() const;

  // The last frame that was observed, or passed, as the intake makes it. Valid until the next, and
  // as long as that frame is; nullptr before the first.
  [[nodiscard]] const image::GrayImage* picture() const;
  // The features as of `step`, the last one that Observe returned: for those who draw them. None in
  // a frame that was passed.
  [[nodiscard]] std::vector<replay::FeatureView> ViewFeatures(const ReplayStep& step) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
