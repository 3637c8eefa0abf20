#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "agent/session/confidence.h"
#include "agent/session/look_around.h"
#include "agent/session/place_finder.h"
#include "agent/session/replay_method.h"
#include "agent/session/replay_step.h"
#include "agent/session/src/features/feature_search.h"
#include "agent/session/src/front_end.h"
#include "agent/session/src/place/experience_taker.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/likeliest_place.h"
#include "agent/session/src/place/localiser.h"
#include "agent/session/src/place/place_trust.h"
#include "agent/session/src/standing.h"
#include "services/motion/motion.h"
#include "services/replay/follower.h"
#include "services/replay/passing.h"
#include "services/replay/turn_flow.h"
#include "services/route/route.h"

namespace trailcast::agent {

// This follows by the features of one segment after the other. It has a method of services/replay
// steer by the tracked ones, judges how far it may be trusted, and seeks features if there are too
// few, if the segment ends, or if the robot is elsewhere.
class FeatureFollower {
 public:
  // `route`, `front_end` and `place` have to outlive it.
  FeatureFollower(const ReplayMethodOptions& options, const vision::PictureSize& scout,
                  const KnownRoute& route, FrontEnd& front_end, Localiser& place);

  // Takes a segment that has just been added to the route.
  void Learn(const route::Segment& segment);
  // Makes it look first where an earlier run has left the robot. Call it before the first frame.
  void GoOnFrom(const LeftAt& left);

  // Returns how to steer by what is seen, where `place` holds the robot to be. `standing` is as the
  // last frame left it, and is updated.
  [[nodiscard]] replay::FollowStep Step(const FrameInput& seen, Standing& standing);

  // Returns the report of such a step; of {}, that nothing is followed yet.
  [[nodiscard]] ReplayStep Report(const replay::FollowStep& step, const Standing& standing) const;

  // Returns what it met since its beginning or the last call, if it was to note that.
  [[nodiscard]] std::optional<refresh::Visit> TakeVisit();

  // Returns the lens of a robot that has been sure of its path, and otherwise the given one.
  [[nodiscard]] std::optional<OwnLens> lens() const;

  // Tells that the robot was put somewhere and does not know its place yet.
  [[nodiscard]] bool seeks_start() const {
    return !follower_ && (start_ == Start::kWhereLeft || start_ == Start::kAnywhere);
  }
  // Tells that the robot follows the route in reverse gear.
  [[nodiscard]] bool reverses() const { return follower_ && follower_->segment().reverse; }
  // This is of the segment that is being followed, and null before the first.
  [[nodiscard]] const replay::Follower* follower() const { return follower_.get(); }

 private:
  // This is where the robot looks for its place on the route, until it begins to follow. From
  // kAtBeginning and kWhereLeft it goes on to kAnywhere if it is not found there. A robot that has
  // followed its path and lost it begins again with kLostItsPath.
  enum class Start {
    kAtBeginning,  // at the route's beginning, without looking
    kWhereLeft,    // where an earlier run left it, or where an operator says that it stands
    kAnywhere,     // anywhere on the route
    kLostItsPath,  // anywhere on the route, after it was followed for a while
  };

  // If the belief's place is this far from the features' place, the robot is somewhere else.
  static constexpr double kElsewhere = 1.0;
  static constexpr double kElsewhereDriving = 2.0;  // for a robot that it moves
  // A handful agree in any picture.
  static constexpr int kEnoughAgreed = 10;
  static constexpr int kEnoughAgreedDriving = 15;

  [[nodiscard]] bool by_odometry() const {
    return front_end_.knows_motion() && UsesOdometry(options_.method);
  }
  [[nodiscard]] bool LooksAnywhere() const {
    return !follower_ && (start_ == Start::kAnywhere || start_ == Start::kLostItsPath);
  }
  // Begins a segment (feature_follower_begin.cc). Returns false if there is nothing to follow yet.
  [[nodiscard]] bool BeginNext(const FrameInput& seen, Standing& standing);
  [[nodiscard]] bool BeginWhereLeft(const FrameInput& seen, Standing& standing);
  [[nodiscard]] bool MeasuresLens(const FrameInput& seen, Standing& standing);
  [[nodiscard]] double MagnificationBy(const replay::FocalLength& focal);
  [[nodiscard]] bool BeginAnywhere(const FrameInput& seen, Standing& standing);
  [[nodiscard]] bool LooksElsewhere(Standing& standing);
  [[nodiscard]] bool LooksAgainIfLost() const;
  [[nodiscard]] bool BeginAbout(const RoutePoint& point);
  [[nodiscard]] bool BeginBy(const RoutePoint& point);
  [[nodiscard]] std::optional<double> BeginBehind(const RoutePoint& by);
  [[nodiscard]] bool MayBeRecognised() const;
  void ForgetCompared();
  void ComparePlaces();
  void CompareSome();
  void BeginAtLikeliest();
  // Describes a part of the route, in its units, for people.
  [[nodiscard]] std::string InWords(double way) const;
  [[nodiscard]] double Unlikely(const std::optional<replay::FocalLength>& focal) const;
  [[nodiscard]] const replay::Follower& Fresh(const route::Segment& first);
  void Make(const route::Segment& first);
  void Begin(const route::Segment& segment);
  void EndSegment(Standing& standing);
  [[nodiscard]] bool IsElsewhereThanAtTheEnd() const;
  [[nodiscard]] bool HasCome() const;

  [[nodiscard]] replay::FollowStep Steer(const FrameInput& seen, Standing& standing);
  [[nodiscard]] replay::FollowStep Turn(const FrameInput& seen, Standing& standing);
  [[nodiscard]] replay::FollowStep Go(const FrameInput& seen, Standing& standing);
  [[nodiscard]] bool EndsAtTheAxle() const;
  void RefuseReverse(Standing& standing) const;
  [[nodiscard]] int InPicture() const;
  [[nodiscard]] Sighting SightOf(const replay::FollowStep& step, const FrameInput& seen) const;
  void Compare(const RoutePoint& point, Sighting& sighting) const;
  void Judge(const replay::FollowStep& step, const FrameInput& seen, Standing& standing);
  void NoteWay(const replay::FollowStep& step, const Standing& standing);
  void LookAroundFirst(const FrameInput& seen, Standing& standing);
  [[nodiscard]] replay::FollowStep LookAroundForAny(const FrameInput& seen, Standing& standing);
  void TurnToLook(const FrameInput& seen, Standing& standing);
  void LookAgain(double fraction, bool elsewhere);
  void LookWhatStands(const replay::FollowStep& step, const FrameInput& seen,
                      const Standing& standing);
  void SteerByWholeView(replay::FollowStep& step) const;
  // Returns the share of the method's speed that is driven.
  [[nodiscard]] double SpeedShare(const replay::FollowStep& step, Trust trust) const;

  ReplayMethodOptions options_;
  int scout_width_px_;
  int frame_width_px_ = 0;  // 0 before the first frame
  const KnownRoute& route_;
  FrontEnd& front_end_;
  Localiser& place_;
  FeatureSearch search_;
  Confidence confidence_;
  replay::Passing passing_;
  LookingAround look_around_;
  // This is a turn to either side that tells the lens, and how far features move meanwhile.
  LookingAround lens_turn_;
  std::optional<replay::TurnFlow> turn_flow_;
  std::optional<replay::FocalLength> focal_;  // in this run's pixels
  PlaceTrust place_trust_;                    // for the printed methods
  double look_again_at_s_ = 0.0;              // when it has been unsure for so long
  // This is the distance along the route while it was sure, since it began at the beginning or was
  // suddenly held to be elsewhere. It is needed because the end of a lap looks like its beginning.
  double came_m_ = 0.0;
  std::optional<double> sure_along_;  // at the last frame; empty if it was not sure
  double turns_unseen_s_ = 0.0;       // on the spot, since something agreed
  Start start_;
  std::optional<PlaceFinder> place_finder_;  // in kWhereLeft, until it has found the place
  std::string not_there_;                    // why it looks there, in kAnywhere and kLostItsPath
  std::vector<RoutePoint> to_compare_;       // places where it may be
  std::vector<PlaceByFeatures> compared_;    // evidence of their features
  std::string nowhere_;                      // why it begins at none of them
  double moved_m_ = 0.0;                     // since it began to compare
  std::optional<ExperienceTaker> experience_;
  // This one knows the route and is nowhere yet. It is kept to be copied, as long as it may be
  // needed.
  std::unique_ptr<replay::Follower> fresh_;
  WayBy fresh_by_ = WayBy::kNothing;
  std::unique_ptr<replay::Follower> follower_;  // made when the first segment begins
};

}  // namespace trailcast::agent
