#pragma once

#include <memory>
#include <optional>
#include <string>

#include "agent/confidence.h"
#include "agent/observation.h"
#include "agent/place_finder.h"
#include "agent/replay_method.h"
#include "agent/replay_state.h"
#include "agent/sight.h"
#include "services/base/result.h"
#include "services/motion/motion.h"
#include "services/replay/feature_view.h"
#include "services/replay/follower.h"
#include "services/route/route.h"

namespace trailcast::agent {

struct ReplayStep {
  motion::VelocityCommand command;  // for the robot's base; zero unless following or blind
  ReplayState state = ReplayState::kWaiting;
  Trust trust = Trust::kSeeking;
  SegmentIndex segment;   // the one being followed
  double fraction = 0.0;  // of that segment, 0..1
  double progress = 0.0;  // of the route as far as it is known, 0..1, by segment count
  // Place on the route, in the scout's metres from its beginning; nothing before the robot has
  // found the route, and on one that was taught without odometry.
  std::optional<double> along_m;
  int features = 0;          // matched and tracked
  double turn_rad = 0.0;     // desired heading change theta_d, positive to the right
  double found_share = 0.0;  // of stored features found, mean over hand-overs so far
  int hand_overs = 0;
  double magnification = 1.0;   // the follower's pixels per scout's
  replay::FollowStep decision;  // what the method saw and asked for
  Sight sight;
  std::string reason;  // kLost, kBlind, kWaiting: one line for people
  // What of the robot has failed, for which it stands until that is over; empty: nothing.
  std::string robot_trouble;
};

// Frames and odometry in, velocity commands out: vision's tracker and finder feeding replay's
// follower. Segments may be added while driving. Touches no socket, lock, disk or clock.
class ReplaySession {
 public:
  // `route` gives the size of the scout's frames; its segment_count and state are not looked at.
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

  // Errors: a frame of another size than the first; odometry that appears or vanishes midway.
  [[nodiscard]] Result<ReplayStep> Observe(const Observation& observation);

  // The features as of `step`, the last one that Observe returned: for those who draw them.
  [[nodiscard]] std::vector<replay::FeatureView> ViewFeatures(const ReplayStep& step) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace trailcast::agent
