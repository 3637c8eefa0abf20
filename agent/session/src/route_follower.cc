#include "agent/session/src/route_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

#include "agent/session/src/place/likeliest_place.h"
#include "agent/session/src/place/path_ahead.h"
#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

// If a robot that stands does not see something where it should be, it will not see it there later.
constexpr double kLookThere_s = 1.5;
// This much of a route may be left when a method says that it has arrived.
constexpr double kEnd = 2.0;
constexpr double kEndShare = 0.05;
// A robot has to have come this far along a route to have arrived.
constexpr double kCome_m = 0.5;
constexpr int kFewTracked = 8;  // the views are asked before these are missed
// A handful of another camera's features agree with a place some metres off, which are too few to
// drive by.
constexpr int kToDriveBy = 10;
constexpr double kThere = 0.5;     // distance from the belief's place, in the route's units
constexpr double kBelieved = 0.3;  // odometry that is trusted more carries a robot

ConfidenceOptions ConfidenceOf(ReplayMethod method) {
  ConfidenceOptions options;
  options.stand_when_covered = !AsPrinted(method);
  return options;
}

// Recognised views count more than features that are not seen, or that lie where they should be if
// the robot were somewhere else. Whatever stands before the camera hides both.
bool ViewsKnowBetter(const CarrierEvidence& e) {
  const bool follows = e.by_features == ReplayState::kFollowing;
  if (e.trust == Trust::kCovered || e.seeks_start) return false;
  if (e.drives && e.agreed < kToDriveBy) return false;
  if (e.by_views == ReplayState::kArrived) return !follows;
  return e.by_views == ReplayState::kFollowing && (!follows || e.trust == Trust::kUnsure);
}

}  // namespace

// Odometry that is trusted carries a robot over a short distance more exactly than a view steers
// it, if the robot is recognised at its estimated place.
Carrier WhoCarries(const CarrierEvidence& evidence) {
  if (!ViewsKnowBetter(evidence)) return Carrier::kFeatures;
  const bool by_odometry = evidence.by_views == ReplayState::kFollowing && evidence.steers &&
                           std::abs(evidence.apart) <= kThere &&
                           evidence.odometry_trust >= kBelieved;
  return by_odometry ? Carrier::kOdometry : Carrier::kViews;
}

RouteFollower::RouteFollower(const ReplayMethodOptions& options, const vision::PictureSize& scout,
                             const KnownRoute& route, FrontEnd& front_end, Localiser& place,
                             ViewFollower views)
    : options_(options),
      route_(route),
      front_end_(front_end),
      place_(place),
      search_(!AsPrinted(options.method), scout.width, front_end, place),
      confidence_(ConfidenceOf(options.method)),
      passing_(options.passing),
      look_around_(AsPrinted(options.method) ? 0.0 : options.look_around_rad),
      starter_(options, scout.width, route, front_end, place, search_, look_around_),
      views_(std::move(views)) {
  if (options.take_experience && !AsPrinted(options.method)) {
    experience_.emplace(scout.width, scout.height);
  }
}

void RouteFollower::Learn(const route::Segment& segment) {
  if (follower_ && segment.index.value() < kMostLearnt) follower_->Learn(segment);
  starter_.NoteLearnt();
}

void RouteFollower::GoOnFrom(const LeftAt& left) {
  starter_.GoOnFrom(left);
  if (left.magnification) search_.hand_over().KnowMagnification(*left.magnification);
  ConfidenceOptions confidence = confidence_.options();
  confidence.not_found = "the place where it was left is not found";
  confidence_ = Confidence(confidence);
}

bool RouteFollower::by_views_alone() const {
  return options_.method == ReplayMethod::kDefault &&
         !(front_end_.knows_motion() && route_.segments().front().has_odometry);
}

bool RouteFollower::WantsLook(Trust trust) const {
  const bool asks = by_views_alone() ? place_.HasMoved() : carrier_ == Carrier::kViews;
  const bool few = std::ssize(front_end_.tracker().Current()) < kFewTracked;
  return asks || few || trust != Trust::kSure || place_.LookIsDue();
}

ReplayStep RouteFollower::Step(const FrameInput& seen, bool looked) {
  if (by_views_alone()) {
    carrier_ = Carrier::kViews;
    ReplayStep step = views_.Step(seen.looked_s);
    // Their flow tells whether the robot moves.
    if (looked) front_end_.FollowSomeOf(place_.look().seen);
    return step;
  }
  ReplayStep step = StepByFeatures(seen);
  carrier_ = Carrier::kFeatures;
  if (AsPrinted(options_.method)) return step;
  ReplayStep views = views_.Step(seen.looked_s);
  carrier_ =
      WhoCarries({.by_features = step.state,
                  .trust = step.trust,
                  .by_views = views.state,
                  .steers = step.command != motion::VelocityCommand{},
                  .seeks_start = !follower_ && starter_.seeks_start(),
                  .drives = front_end_.drives(),
                  .agreed = place_.agreed_now(),
                  .apart = place_.where().along - place_.AlongOf({step.segment, step.fraction}),
                  .odometry_trust = place_.TrustInOdometry().value_or(0.0)});
  if (carrier_ == Carrier::kViews) {
    views.sight = std::move(step.sight);
    views.found_share = step.found_share;
    views.hand_overs = step.hand_overs;
    return views;
  }
  if (carrier_ == Carrier::kOdometry) {
    step.state = views.state;
    step.trust = Trust::kUnsure;
  }
  return step;
}

Evidence RouteFollower::EvidenceOf(const ReplayStep& step) const {
  if (step.state == ReplayState::kFollowing) {
    return carrier_ == Carrier::kViews ? Evidence::kViews : Evidence::kFeatures;
  }
  return step.command == motion::VelocityCommand{} ? Evidence::kNothing : Evidence::kMotion;
}

ReplayStep RouteFollower::StepByFeatures(const FrameInput& seen) {
  search_.Open(*seen.frame);
  frame_width_px_ = seen.frame->width;
  if (const auto magnification = place_.Magnification(seen.frame->width)) {
    search_.hand_over().SetRunMagnification(*magnification);
  }
  const Next next = Decide(seen);
  waits_ = next.stands == ReplayState::kWaiting ? std::optional(next.verdict) : std::nullopt;
  if (experience_ && follower_) {
    experience_->Look(seen, *follower_, front_end_.tracker().Current(),
                      next.verdict.trust == Trust::kSure && !confidence_.recognised_only());
  }
  return Report(next);
}

std::optional<refresh::Visit> RouteFollower::TakeVisit() {
  if (!experience_ || !follower_) return std::nullopt;
  return experience_->Take(*follower_);
}

std::optional<OwnLens> RouteFollower::lens() const {
  if (!follower_ || !confidence_.ever_sure()) return options_.lens;
  const auto focal = follower_->focal();
  if (!focal || frame_width_px_ == 0) return options_.lens;
  return OwnLens{focal->px / frame_width_px_, focal->sigma};
}

Next RouteFollower::Decide(const FrameInput& seen) {
  Next next;
  if (follower_ && !waits_) {
    next = follower_->turning() ? Turn(seen) : Go(seen);
  } else if (const auto stands = BeginNext(seen)) {
    return *stands;
  } else {
    next.step = follower_->Step({front_end_.tracker().Current(), seen.driven, seen.unknown});
    next.verdict = Judge(next.step, seen);
  }
  const auto& [trust, reason] = next.verdict;
  const bool in_vain =
      !place_.where().held && (trust == Trust::kLost ||
                               (trust == Trust::kSeeking && confidence_.unsure_s() > kLookThere_s));
  if (in_vain) {
    if (const auto elsewhere = LookElsewhere(reason)) return {{}, *elsewhere};
  }
  if (!AsPrinted(options_.method) || !follower_->segment().reverse) return next;
  return {std::move(next.step),
          {Trust::kLost, fmt::format("the route is driven backwards here, which the method '{}' "
                                     "does not do: follow it by the method 'default'",
                                     ToString(options_.method))}};
}

// Begins a segment for a robot that stands without one. Returns how it stands on if there is none.
std::optional<Next> RouteFollower::BeginNext(const FrameInput& seen) {
  if (follower_) {
    const std::size_t next = follower_->segment().index.value() + 1;
    if (route_.has(next)) {
      search_.Begin(*follower_, route_.segments()[next]);
      return std::nullopt;
    }
    return Next{{}, *waits_, route_.complete() ? ReplayState::kArrived : ReplayState::kWaiting};
  }
  auto start = starter_.Step(seen);
  if (auto* stands = std::get_if<Next>(&start)) return std::move(*stands);
  auto& begun = std::get<Begun>(start);
  follower_ = std::move(begun.follower);
  if (begun.recognised) confidence_.SetFound();
  if (begun.sought) came_m_ = kCome_m;
  place_trust_ = begun.place_trust;
  look_again_at_s_ = begun.look_again_at_s;
  return std::nullopt;
}

// Has a robot that does not see its path for that reason look along the whole route from now on.
// Returns nothing if it may not.
std::optional<Verdict> RouteFollower::LookElsewhere(const std::string& why) {
  const bool lost = confidence_.ever_sure();
  auto verdict = lost ? starter_.LookElsewhere(Starter::LostPath{why, follower_->focal()})
                      : starter_.LookElsewhere(std::nullopt);
  if (!verdict) return verdict;
  if (lost) confidence_.SeekAnew("the path is not found again");
  follower_.reset();
  return verdict;
}

// Turns on the spot before a segment, by odometry, and by the segment's features once they come
// into view. Then the robot has to be sure of them before it drives on.
Next RouteFollower::Turn(const FrameInput& seen) {
  const replay::FollowStep step = follower_->Step({seen.features, seen.driven, seen.unknown});
  const bool agrees =
      step.agreeing >= confidence_.options().min_features || place_.agreed_now() >= kEnoughAgreed;
  turns_unseen_s_ = agrees ? 0.0 : turns_unseen_s_ + seen.looked_s;
  Next next{step, {Trust::kSure, "turns on the spot"}};
  if (turns_unseen_s_ > confidence_.options().unsure_limit_s) {
    next.verdict = {Trust::kBlind, "turns on the spot, by odometry alone"};
  }
  place_.SetTracked(std::nullopt, 0);
  if (Believed(0.0).elsewhere) {
    look_again_at_s_ = 0.0;
    LookAgain(0.0, true);
    return next;
  }
  if (follower_->turn_is_in_view()) {
    search_.Refresh(*follower_, step.agreeing, seen.looked_s, false);
  }
  if (follower_->turning()) return next;
  search_.HandOverTo(*follower_);
  confidence_.SeekAnew(
      fmt::format("after turning on the spot by {:.0f} degrees the way on is not "
                  "found",
                  Degrees(std::abs(follower_->segment().turn_before_rad))));
  return next;
}

Next RouteFollower::Go(const FrameInput& seen) {
  const SegmentIndex before = follower_->segment().index;
  Next next;
  replay::FollowStep& step = next.step;
  step = follower_->Step({seen.features, seen.driven, seen.unknown,
                          follower_->segment().reverse ? 0.0 : passing_.left_m()});
  next.verdict = Judge(step, seen);
  const bool anew = follower_->segment().index != before;  // it has found itself elsewhere
  if (look_around_.turns()) step.command = {0.0, look_around_.turn_rate_radps()};
  if (!anew) LookWhatStands(step, seen, next.verdict.trust);
  if (!AsPrinted(options_.method)) {
    search_.Refresh(*follower_, step.agreeing, seen.looked_s, step.carried_left_m.has_value());
  }
  // A segment is over once the camera is past it. But if the robot has to stop there, to turn on
  // the spot or to drive on in the other direction, its axle has to get there.
  const bool stands_after = route_.stands_after(follower_->segment().index);
  if (anew) {
    step.ended = step.wants_next = false;
  } else if (step.offset && stands_after) {
    step.ended = step.offset->along_m >= follower_->segment().length_m;
  }
  const bool next_is_here = route_.has(follower_->segment().index.value() + 1);
  // Whatever covers this segment's features covers the next one's too.
  const bool covered =
      next.verdict.trust == Trust::kCovered || confidence_.view_is_going() || look_around_.turns();
  const bool wants_next = step.wants_next && next_is_here && !covered && !stands_after;
  const bool lost = next.verdict.trust == Trust::kLost;
  if (!lost && (step.ended || wants_next)) next = EndSegment(std::move(next));
  // A segment that has just begun has less progress than the last one had.
  if (follower_->segment().index != before) {
    step.fraction = 0.0;
    if (step.offset) step.offset->along_m -= route_.segment(before).length_m;
  }
  if (confidence_.recognised_only()) step = SteeredByWholeView(std::move(step));
  return next;
}

// Notes obstacles, for the next frame to steer by.
void RouteFollower::LookWhatStands(const replay::FollowStep& step, const FrameInput& seen,
                                   Trust trust) {
  if (seen.stands == nullptr || !step.offset || follower_->segment().reverse) return;
  const SegmentIndex index = follower_->segment().index;
  const double along_m = step.offset->along_m;
  passing_.Look(*step.offset, route_.begin_m(index) + along_m, trust == Trust::kSure,
                PathAheadOf(route_, index, along_m, options_.passing.look_ahead_m), *seen.stands);
}

// Returns the step of a robot that has lost the segment's features, where the view as a whole is
// recognised.
replay::FollowStep RouteFollower::SteeredByWholeView(replay::FollowStep step) const {
  const ViewSteering by_views = SteerByViews(
      place_, options_.speed_factor * follower_->segment().speed_mps(), options_.limits);
  if (by_views.turn.features == 0) return step;
  step.turn_rad = step.vision_turn_rad = by_views.turn.turn_rad;
  step.command = by_views.command;
  return step;
}

// Begins the next segment, if it is known. Otherwise it is decided whether the robot has arrived.
Next RouteFollower::EndSegment(Next next) {
  const std::size_t following = follower_->segment().index.value() + 1;
  const double turn_rad = route_.turn_after_rad(follower_->segment().index);
  const belief::RouteBelief::Place& where = place_.where();
  const double length = place_.belief().length();
  const double left = length - where.along;
  const bool is_elsewhere = where.held && left > std::max(kEnd, kEndShare * length);
  const bool has_come = std::max(came_m_, where.come) >= std::min(kCome_m, 0.5 * route_.length_m());
  if (AsPrinted(options_.method) && std::abs(turn_rad) > kTurnsAway_rad) {
    next.verdict = {Trust::kLost,
                    fmt::format("the route turns on the spot here, by {:.0f} degrees, which the "
                                "method '{}' does not do: follow it by the method 'default'",
                                Degrees(turn_rad), ToString(options_.method))};
  } else if (route_.has(following)) {
    search_.Begin(*follower_, route_.segments()[following]);
  } else if (!route_.complete()) {
    next.stands = ReplayState::kWaiting;
    next.verdict.reason = fmt::format("waiting for segment {}: not received yet", following);
  } else if (!is_elsewhere && has_come) {
    next.stands = ReplayState::kArrived;
    next.verdict.reason = "arrived at the end of the route";
  } else {
    next.verdict = {Trust::kLost,
                    fmt::format("the last segment is over, but what is seen is {} before its end",
                                InWords(left, {length, place_.metric()}))};
  }
  return next;
}

}  // namespace trailcast::agent
