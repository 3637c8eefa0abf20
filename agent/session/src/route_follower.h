#pragma once

#include <memory>
#include <optional>
#include <string>

#include "agent/session/confidence.h"
#include "agent/session/look_around.h"
#include "agent/session/replay_method.h"
#include "agent/session/replay_step.h"
#include "agent/session/src/features/feature_search.h"
#include "agent/session/src/features/starter.h"
#include "agent/session/src/front_end.h"
#include "agent/session/src/place/experience_taker.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/localiser.h"
#include "agent/session/src/place/place_trust.h"
#include "agent/session/src/place/view_follower.h"
#include "services/replay/follower.h"
#include "services/replay/passing.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This is what a robot's step goes by, where it has both a segment's features and key views.
enum class Carrier {
  kFeatures,
  kViews,
  kOdometry,  // the step by features, although they are not seen, since views show that it is right
};

// This is the evidence for and against a step by features.
struct CarrierEvidence {
  // These are what following by features alone, and by views alone, would report.
  ReplayState by_features = ReplayState::kWaiting;
  Trust trust = Trust::kSeeking;  // in the features
  ReplayState by_views = ReplayState::kWaiting;
  bool steers = false;       // the features' step has a command
  bool seeks_start = false;  // the robot was put somewhere, and the features do not tell where yet
  bool drives = false;       // commands move the robot, so that a wrong one leads it astray
  int agreed = 0;            // features of the key views around the place
  double apart = 0.0;        // from the features' place to the belief's, in the route's units
  double odometry_trust = 0.0;
};

[[nodiscard]] Carrier WhoCarries(const CarrierEvidence& evidence);

// This follows a route by its features and by its key views. By features it follows one segment
// after the other: it has a method of services/replay steer by the tracked ones, judges how far it
// may be trusted, and seeks features if there are too few, if the segment ends, or if the robot is
// elsewhere. In each frame it decides what carries the robot.
class RouteFollower {
 public:
  // `route`, `front_end` and `place` have to outlive it.
  RouteFollower(const ReplayMethodOptions& options, const vision::PictureSize& scout,
                const KnownRoute& route, FrontEnd& front_end, Localiser& place, ViewFollower views);
  RouteFollower(const RouteFollower&) = delete;  // its parts know each other
  RouteFollower& operator=(const RouteFollower&) = delete;

  // Takes a segment that has just been added to the route.
  void Learn(const route::Segment& segment);
  // Makes it look first where an earlier run has left the robot. Call it before the first frame.
  void GoOnFrom(const LeftAt& left);

  // Tells that our own method goes by what is recognised alone, since nothing tells how the robot
  // or the scout moved.
  [[nodiscard]] bool by_views_alone() const;
  // Tells whether what is recognised of the route is worth a look in this frame. A robot that is
  // sure of many features, by the last one's `trust`, looks only now and then. One that goes by
  // what is recognised looks unless its picture stands still.
  [[nodiscard]] bool WantsLook(Trust trust) const;
  // Returns how to go on by what is seen, where `place` holds the robot to be. `looked` says that
  // it has looked what is recognised.
  [[nodiscard]] ReplayStep Step(const FrameInput& seen, bool looked);
  // Returns the report of a robot that follows nothing yet.
  [[nodiscard]] ReplayStep ReportOf(const Verdict& verdict, ReplayState state) const;
  // Returns what this step goes by, which is one of Step, or stands instead.
  [[nodiscard]] Evidence EvidenceOf(const ReplayStep& step) const;

  // Returns what it met since its beginning or the last call, if it was to note that.
  [[nodiscard]] std::optional<refresh::Visit> TakeVisit();
  // Returns the lens of a robot that has been sure of its path, and otherwise the given one.
  [[nodiscard]] std::optional<OwnLens> lens() const;
  // Tells that the robot follows the route in reverse gear.
  [[nodiscard]] bool reverses() const { return follower_ && follower_->segment().reverse; }
  // This is of the segment that is being followed, and null before the first.
  [[nodiscard]] const replay::Follower* follower() const { return follower_.get(); }
  [[nodiscard]] const ViewFollower& views() const { return views_; }

 private:
  [[nodiscard]] ReplayStep StepByFeatures(const FrameInput& seen);
  [[nodiscard]] Next Decide(const FrameInput& seen);
  [[nodiscard]] std::optional<Next> BeginNext(const FrameInput& seen);
  [[nodiscard]] std::optional<Verdict> LookElsewhere(const std::string& why);
  [[nodiscard]] Next Turn(const FrameInput& seen);
  [[nodiscard]] Next Go(const FrameInput& seen);
  void LookWhatStands(const replay::FollowStep& step, const FrameInput& seen, Trust trust);
  [[nodiscard]] replay::FollowStep SteeredByWholeView(replay::FollowStep step) const;
  [[nodiscard]] Next EndSegment(Next next);
  // These are in route_follower_judge.cc and route_follower_report.cc.
  [[nodiscard]] Verdict Judge(const replay::FollowStep& step, const FrameInput& seen);
  [[nodiscard]] Sighting Believed(double fraction) const;
  [[nodiscard]] Sighting SightingOf(const replay::FollowStep& step, const FrameInput& seen) const;
  void LookAgain(double fraction, bool elsewhere);
  [[nodiscard]] ReplayStep Report(const Next& next) const;

  ReplayMethodOptions options_;
  int frame_width_px_ = 0;  // 0 before the first frame
  const KnownRoute& route_;
  FrontEnd& front_end_;
  Localiser& place_;
  FeatureSearch search_;
  Confidence confidence_;
  replay::Passing passing_;
  LookingAround look_around_;
  Starter starter_;
  ViewFollower views_;
  Carrier carrier_ = Carrier::kFeatures;  // in the last frame
  std::optional<Verdict> waits_;          // by features, for the next segment
  PlaceTrust place_trust_;                // for the printed methods
  double look_again_at_s_ = 0.0;          // when it has been unsure for so long
  // This is the distance along the route while it was sure, since it began at the beginning or was
  // suddenly held to be elsewhere. It is needed because the end of a lap looks like its beginning.
  double came_m_ = 0.0;
  std::optional<double> sure_along_;  // at the last frame; empty if it was not sure
  double turns_unseen_s_ = 0.0;       // on the spot, since something agreed
  std::optional<ExperienceTaker> experience_;
  std::unique_ptr<replay::Follower> follower_;  // null until the first segment begins
};

}  // namespace trailcast::agent
