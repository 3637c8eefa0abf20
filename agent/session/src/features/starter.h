#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "agent/session/confidence.h"
#include "agent/session/look_around.h"
#include "agent/session/place_finder.h"
#include "agent/session/replay_method.h"
#include "agent/session/replay_state.h"
#include "agent/session/src/features/feature_search.h"
#include "agent/session/src/front_end.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/likeliest_place.h"
#include "agent/session/src/place/localiser.h"
#include "agent/session/src/place/place_trust.h"
#include "services/replay/focal_length.h"
#include "services/replay/follower.h"
#include "services/replay/turn_flow.h"
#include "services/route/route.h"
#include "services/route/tracked_feature.h"

namespace trailcast::agent {

// If the belief's place is this far from the features' place, the robot is somewhere else.
inline constexpr double kOtherPlace = 1.0;
// A handful of features agree in any picture.
inline constexpr int kEnoughAgreed = 10;
// So many segments are enough to learn the scout's camera; each takes a fraction of a millisecond.
inline constexpr std::size_t kMostLearnt = 200;

// This is what is decided in a frame: how to steer, and how far that may be trusted.
struct Next {
  replay::FollowStep step;
  Verdict verdict;
  // This is the state of a robot that stands although it may be trusted: it waits or has arrived.
  std::optional<ReplayState> stands = std::nullopt;

  [[nodiscard]] ReplayState state() const { return stands.value_or(StateOf(verdict.trust)); }
};

// This is a follower that has begun a segment where the robot was found to be.
struct Begun {
  std::unique_ptr<replay::Follower> follower;  // null if it cannot begin
  double along = 0.0;                          // that place along the route, if it was sought
  bool sought = false;                         // rather than being taken to be the beginning
  bool recognised = false;                     // other evidence than these features shows it
  PlaceTrust place_trust = PlaceTrust();
  double look_again_at_s = 0.0;  // its features have just been sought, and need not be before
};

// Has a robot that is lost turn on the spot to look for its path. Returns the verdict while it does
// and after it has; one that is not to turn stays lost.
[[nodiscard]] Verdict TurnToLook(LookingAround& look_around, const FrameInput& seen, Verdict lost);

// This turns a robot a little to either side, once, by which its focal length becomes known. A
// robot that stands cannot tell its place and its camera's magnification apart.
class LensTurn {
 public:
  // It turns no further than `furthest_rad`, and with 0 never.
  explicit LensTurn(double furthest_rad);

  // Sets what is known otherwise.
  void Know(const std::optional<replay::FocalLength>& focal) { focal_ = focal; }
  // Takes the features of a picture of that width, which have to be followed from the first one on,
  // and how far the robot has turned to the left since the last. Returns true as long as it should
  // turn.
  [[nodiscard]] bool Turn(const std::vector<route::TrackedFeature>& seen, int width_px,
                          double turned_rad, double dt_s);

  [[nodiscard]] bool begun() const { return flow_.has_value(); }
  [[nodiscard]] bool turns() const { return turn_.turns(); }
  [[nodiscard]] double turn_rate_radps() const { return turn_.turn_rate_radps(); }
  [[nodiscard]] const std::optional<replay::FocalLength>& focal() const { return focal_; }

 private:
  LookingAround turn_;
  std::optional<replay::TurnFlow> flow_;
  std::optional<replay::FocalLength> focal_;
};

// This finds out where a robot is that does not follow the route yet, or no longer, and begins to
// follow there. It is in one phase after the other: at the route's beginning, or where it was left,
// and if it is not found there, anywhere.
class Starter {
 public:
  // All but the options have to outlive it.
  Starter(const ReplayMethodOptions& options, int scout_width_px, const KnownRoute& route,
          FrontEnd& front_end, Localiser& place, FeatureSearch& search, LookingAround& look_around);

  // More of the route has become known.
  void NoteLearnt() { fresh_.reset(); }
  // Makes it look first where an earlier run has left the robot.
  void GoOnFrom(const LeftAt& left) { phase_ = WhereLeft{PlaceFinder(left)}; }

  // Returns the follower that has begun in this frame, or what a robot does until then.
  [[nodiscard]] std::variant<Begun, Next> Step(const FrameInput& seen);

  // This is a robot that has followed its path and lost it, and why.
  struct LostPath {
    std::string why;
    std::optional<replay::FocalLength> focal;  // as it was learnt
  };
  // Has it look along the whole route for a robot that is not where it began, or has lost its path.
  // Returns the verdict, or nothing if it may not look.
  [[nodiscard]] std::optional<Verdict> LookElsewhere(const std::optional<LostPath>& lost);

  // Tells that the robot was put somewhere else than at the route's beginning.
  [[nodiscard]] bool seeks_start() const;

 private:
  struct AtBeginning {};  // without looking
  struct WhereLeft {      // where an earlier run left it, or where an operator says that it stands
    PlaceFinder finder;
  };
  struct Anywhere {
    std::string not_there;      // why it looks there
    bool has_followed = false;  // its path, for a while, and lost it
    PlaceTrust trust = PlaceTrust();
    double compare_at_s = 0.0;                   // from now
    std::vector<RoutePoint> to_compare = {};     // places where it may be
    std::vector<PlaceByFeatures> compared = {};  // evidence of their features
    std::string nowhere = {};                    // why it begins at none of them
    double moved_m = 0.0;                        // since it began to compare
    void Forget();
  };
  using Outcome = std::variant<Begun, Next>;

  [[nodiscard]] Outcome Look(AtBeginning& phase, const FrameInput& seen);
  [[nodiscard]] Outcome Look(WhereLeft& phase, const FrameInput& seen);
  [[nodiscard]] Outcome Look(Anywhere& phase, const FrameInput& seen);
  // Returns what a robot does that turns to measure its lens, or nothing if it does not.
  [[nodiscard]] std::optional<Next> MeasureLens(const FrameInput& seen,
                                                const std::string& not_there);
  [[nodiscard]] std::vector<RoutePoint> ToCompare() const;
  void CompareSome(Anywhere& phase);
  [[nodiscard]] PlaceByFeatures SeenBy(replay::Follower& follower, const RoutePoint& from) const;
  [[nodiscard]] Begun BeginAtLikeliest(Anywhere& phase);
  [[nodiscard]] Begun BeginBehind(const RoutePoint& by);
  [[nodiscard]] std::unique_ptr<replay::Follower> BeginAbout(const RoutePoint& point);
  [[nodiscard]] std::unique_ptr<replay::Follower> BeginBy(const RoutePoint& point);
  [[nodiscard]] double MagnificationBy(const replay::FocalLength& focal);
  [[nodiscard]] const replay::Follower& Fresh(const route::Segment& first);

  ReplayMethodOptions options_;
  int scout_width_px_;
  const KnownRoute& route_;
  FrontEnd& front_end_;
  Localiser& place_;
  FeatureSearch& search_;
  LookingAround& look_around_;
  LensTurn lens_;
  std::variant<AtBeginning, WhereLeft, Anywhere> phase_;
  // This one knows the route and is nowhere yet. It is kept to be copied, as long as it may be
  // needed.
  std::unique_ptr<replay::Follower> fresh_;
  WayBy fresh_by_ = WayBy::kNothing;
};

}  // namespace trailcast::agent
