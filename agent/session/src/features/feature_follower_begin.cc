// This decides where a segment begins to be followed, and where the last one ends.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "agent/session/src/features/feature_follower.h"
#include "agent/session/src/place/path_ahead.h"
#include "services/base/angles.h"
#include "services/base/square.h"

namespace trailcast::agent {
namespace {

// So many segments are enough to learn the scout's camera; each takes a fraction of a millisecond.
constexpr std::size_t kMostLearnt = 200;
constexpr double kFound_m = 0.3;
// A robot's stated place may be wrong by this much; so may a place among views that look alike
// apart from their size.
constexpr double kTold_m = 0.3;
constexpr double kAlike_m = 2.0;
// These are for places that look alike: how many are compared, and their least probability, and how
// often while the robot stands; how far before and behind each one it looks, in the route's units;
// how many segments in one frame; and how far apart places may be that count as one.
constexpr std::size_t kMostCompared = 6;
constexpr double kLeastCompared = 0.01;
constexpr double kCompare_s = 0.5;
constexpr double kLooksAlike = 20.0;
constexpr std::size_t kComparedAtOnce = 3;
constexpr double kOnePlace = 3.0;
constexpr int kEnoughHeld = 6;  // features, where the belief holds it to be there
// The robot may begin this far before the route's beginning, or beyond its end. Further off it is
// not on the route.
constexpr double kOutside = 1.0;
// This much of a route may be left when a method says that it has arrived.
constexpr double kEnd = 2.0;
constexpr double kEndShare = 0.05;
// A robot has to have come this far along a route to have arrived.
constexpr double kCome_m = 0.5;

}  // namespace

void FeatureFollower::Learn(const route::Segment& segment) {
  if (follower_ && segment.index.value() < kMostLearnt) follower_->Learn(segment);
  fresh_.reset();
}

void FeatureFollower::GoOnFrom(const LeftAt& left) {
  start_ = Start::kWhereLeft;
  place_finder_.emplace(left);
  if (left.magnification) search_.hand_over().KnowMagnification(*left.magnification);
  ConfidenceOptions confidence = confidence_.options();
  confidence.not_found = "the place where it was left is not found";
  confidence_ = Confidence(confidence);
}

const replay::Follower& FeatureFollower::Fresh(const route::Segment& first) {
  const WayBy way = !front_end_.knows_motion() || !first.has_odometry ? WayBy::kNothing
                    : !place_.metric()                                ? WayBy::kSight
                    : front_end_.has_odometry()                       ? WayBy::kOdometry
                                                                      : WayBy::kCommands;
  if (fresh_ && fresh_by_ == way) return *fresh_;
  const auto known =
      place_finder_ && !place_finder_->told() ? place_finder_->left().magnification : std::nullopt;
  const double alike = static_cast<double>(search_.frame().width) / scout_width_px_;
  fresh_ = MakeFollower(options_, way, scout_width_px_, known.value_or(alike), known.has_value());
  fresh_by_ = way;
  const std::size_t learnt = std::min(route_.segments().size(), kMostLearnt);
  for (std::size_t i = 0; i < learnt; ++i) fresh_->Learn(route_.segments()[i]);
  return *fresh_;
}

void FeatureFollower::Make(const route::Segment& first) { follower_ = Fresh(first).Clone(); }

// This is the hand-over: the segment's stored features are found in this frame and followed from
// here.
void FeatureFollower::Begin(const route::Segment& segment) {
  if (!follower_) Make(segment);
  follower_->Begin(segment);
  if (follower_->turning()) {  // the features are not in view yet
    search_.Forget();
  } else {
    search_.HandOverTo(*follower_);
  }
}

// Finds a segment to follow for a robot that stands without one.
bool FeatureFollower::BeginNext(const FrameInput& seen, Standing& standing) {
  if (!follower_ && start_ == Start::kWhereLeft) return BeginWhereLeft(seen, standing);
  if (LooksAnywhere()) return BeginAnywhere(seen, standing);
  const std::size_t next = follower_ ? follower_->segment().index.value() + 1 : 0;
  if (route_.has(next)) {
    Begin(route_.segments()[next]);
    return true;
  }
  if (route_.complete() && follower_) standing.state = ReplayState::kArrived;
  return false;
}

bool FeatureFollower::BeginWhereLeft(const FrameInput& seen, Standing& standing) {
  if (place_finder_->told()) {
    if (MeasuresLens(seen, standing)) return false;
    if (focal_ && !place_finder_->left().magnification) {
      place_finder_->KnowMagnification(MagnificationBy(*focal_));
    }
  }
  const auto recognised_m =
      place_.where().held ? std::optional(place_.where().along) : std::nullopt;
  if (const auto found = place_finder_->Look(search_.frame(), route_.segments(),
                                             search_.hand_over(), recognised_m)) {
    const route::Segment& segment = route_.segment(found->segment);
    Make(segment);
    if (place_finder_->told()) {
      follower_->BeginAbout(segment, found->fraction, {kTold_m, focal_});
    } else {
      follower_->BeginAt(segment, found->fraction);
    }
    place_.StartAt(place_.AlongOf({found->segment, found->fraction}), kFound_m);
    came_m_ = kCome_m;
    search_.TakeUpWhereLeft(found->seen, *follower_);
    place_finder_.reset();
    if (recognised_m && std::abs(*recognised_m - place_.where().along) < kElsewhere) {
      confidence_.SetFound();
    }
    return true;
  }
  if (place_finder_->given_up() && LooksElsewhere(standing)) return false;
  const LeftAt& left = place_finder_->left();
  const std::string there =
      fmt::format("where it {}, {:.1f} m along the route",
                  place_finder_->told() ? "is said to stand" : "was left", left.along_m);
  standing.state = ReplayState::kBlind;
  standing.reason = "looks whether it is " + there;
  if (!place_finder_->given_up()) return false;
  const char* elsewhere =
      place_finder_->told() ? "nor within half a metre: " : "nor at the route's start: ";
  const char* what_to_do = place_finder_->told()
                               ? "Put it there, or send it from where it stands"
                               : "Put it back to either, or begin at the start all the same with "
                                 "--from-start";
  standing.state = ReplayState::kLost;
  standing.trust = Trust::kLost;
  standing.reason = fmt::format("not {}, {}{} in view at best. {}", there, elsewhere,
                                place_finder_->MostSeen(), what_to_do);
  return false;
}

// Handles a robot that is not at its stated place, or has lost its path. Returns true if it looks
// along the whole route from now on.
bool FeatureFollower::LooksElsewhere(Standing& standing) {
  const bool lost = confidence_.ever_sure();
  if (lost ? !LooksAgainIfLost() : !options_.else_anywhere || start_ == Start::kAnywhere) {
    return false;
  }
  not_there_ = lost                          ? "it has lost its path (" + standing.reason + "): "
               : start_ == Start::kWhereLeft ? "it is not where it was left: "
                                             : "it is not at the route's start: ";
  if (lost) {
    focal_ = follower_->focal();
    confidence_.SeekAnew("the path is not found again");
  }
  start_ = lost ? Start::kLostItsPath : Start::kAnywhere;
  follower_.reset();
  fresh_.reset();
  place_finder_.reset();
  search_.Forget();
  place_.StartAnywhere();
  place_trust_ = PlaceTrust();
  look_again_at_s_ = 0.0;
  ForgetCompared();
  standing = {ReplayState::kBlind, Trust::kSeeking, not_there_ + "looks where on the route it is"};
  return true;
}

// Our own method tells its place on the route by features, and can look again.
bool FeatureFollower::LooksAgainIfLost() const {
  return (options_.else_anywhere || options_.anywhere) && !AsPrinted(options_.method) && follower_;
}

// Finds a segment for a robot that may be anywhere on the route.
bool FeatureFollower::BeginAnywhere(const FrameInput& seen, Standing& standing) {
  const bool turned = lens_turn_.turns();
  if (turned && MeasuresLens(seen, standing)) return false;
  Verdict verdict = place_trust_.Judge(place_.where(), seen.looked_s,
                                       "a place is recognised, but too few of its features");
  const bool lost = verdict.trust == Trust::kLost;
  standing = {
      lost ? ReplayState::kLost : ReplayState::kBlind, lost ? Trust::kLost : Trust::kSeeking,
      not_there_ +
          "looks where on the route it is: " + (nowhere_.empty() ? verdict.reason : nowhere_)};
  if (seen.driven) moved_m_ += std::abs(seen.driven->distance_m);
  if (moved_m_ > kOnePlace || !MayBeRecognised()) ForgetCompared();
  if (!nowhere_.empty()) return false;  // looking at the same until it fits would be guessing
  if (!lost) look_around_.Rest();
  if (!turned && MayBeRecognised() && MeasuresLens(seen, standing)) return false;
  look_again_at_s_ -= seen.looked_s;
  if (to_compare_.empty() && MayBeRecognised() && look_again_at_s_ <= kTimeSlack_s) {
    look_again_at_s_ = kCompare_s;
    ComparePlaces();
  }
  if (to_compare_.empty()) return false;
  CompareSome();
  if (to_compare_.empty()) BeginAtLikeliest();
  return follower_ != nullptr;
}

// Discards comparisons made before the robot moved.
void FeatureFollower::ForgetCompared() {
  to_compare_.clear();
  compared_.clear();
  nowhere_.clear();
  moved_m_ = 0.0;
}

bool FeatureFollower::MayBeRecognised() const {
  return place_.where().held || place_.where().agreed >= kEnoughAgreed;
}

// A robot that stands cannot tell its place and its camera's magnification apart. Turning tells the
// second. It does so once.
bool FeatureFollower::MeasuresLens(const FrameInput& seen, Standing& standing) {
  if (focal_ || lens_turn_.furthest_rad() == 0.0 || !seen.measured) return false;
  if (!turn_flow_) {
    turn_flow_.emplace(seen.frame->width);
    front_end_.tracker().Detect();
  } else {
    turn_flow_->Look(seen.features, seen.measured->heading_change_rad);
  }
  if (!lens_turn_.Turn(seen.measured->heading_change_rad, seen.looked_s)) {
    focal_ = turn_flow_->focal();
    return false;
  }
  standing = {
      ReplayState::kBlind, Trust::kLooking,
      not_there_ + "turns a little to either side to see how large its camera shows things"};
  return true;
}

// Returns the magnification that follows from the route's knowledge of the scout's camera.
double FeatureFollower::MagnificationBy(const replay::FocalLength& focal) {
  const replay::Follower& alike = Fresh(route_.segments().front());
  const auto its = alike.focal();
  return its ? alike.magnification() * focal.px / its->px : alike.magnification();
}

// Places apart can look alike, and views may be recognised from many metres further on. This
// collects the places where the robot may be and, if its camera is known, which makes the
// comparison cheap and tells near from far, every segment's beginning around them. Their features
// are compared next.
void FeatureFollower::ComparePlaces() {
  compared_.clear();
  moved_m_ = 0.0;
  std::vector<double> places{place_.where().along};
  if (!place_.where().held) {
    places = place_.belief().Likeliest(kMostCompared, kLeastCompared, kAlike_m);
  }
  if (!focal_) {
    for (const double place : places) to_compare_.push_back(place_.PointAt(place));
    return;
  }
  for (const route::Segment& segment : route_.segments()) {
    const double begins = place_.AlongOf({segment.index, 0.0});
    const auto is_near = [&](double place) { return std::abs(place - begins) < kLooksAlike; };
    if (std::any_of(places.begin(), places.end(), is_near)) {
      to_compare_.push_back({segment.index, 0.0});
    }
  }
}

// Compares as many as one picture leaves time for: how many of a segment's features lie as a robot
// somewhere around there would see them, and from where.
void FeatureFollower::CompareSome() {
  const HandOver unlearnt = search_.hand_over();
  const auto magnification = focal_ ? std::optional(MagnificationBy(*focal_)) : std::nullopt;
  for (std::size_t i = 0; i < kComparedAtOnce && !to_compare_.empty(); ++i) {
    const RoutePoint point = to_compare_.back();
    to_compare_.pop_back();
    if (magnification) search_.hand_over().KnowMagnification(*magnification);
    if (focal_ ? BeginBy(point) : BeginAbout(point)) {
      const replay::FollowStep step = follower_->Step({front_end_.tracker().Current(), {{}}, {}});
      const RoutePoint there{follower_->segment().index, step.fraction};
      PlaceByFeatures place{.along = place_.AlongOf(there)};
      place.by = there.segment == point.segment ? point : RoutePoint{there.segment, 0.0};
      if (step.offset && place_.metric()) {
        place.along = place_.AlongOf({there.segment, 0.0}) + step.offset->along_m;
        place.along_sigma = step.offset->along_sigma_m;
      }
      place.agreeing = step.agreeing;
      place.share = static_cast<double>(step.agreeing) / std::max(1, InPicture());
      place.magnification = follower_->magnification();
      place.speaks = step.agreeing - Unlikely(follower_->focal());
      compared_.push_back(place);
    }
    search_.hand_over() = unlearnt;
  }
  follower_.reset();
  search_.Forget();
}

std::string FeatureFollower::InWords(double way) const {
  if (place_.metric()) return fmt::format("{:.1f} m", way);
  return fmt::format("{:.0f} % of the route", 100.0 * way / place_.belief().length());
}

// Begins at the likeliest of the compared places, if they are one place on the route.
void FeatureFollower::BeginAtLikeliest() {
  nowhere_.clear();
  const auto likeliest = LikeliestOf(compared_);
  const int enough = place_.where().held ? kEnoughHeld : kEnoughAgreed;
  if (!likeliest || likeliest->best.agreeing < enough) return;
  const auto& [best, first, last] = *likeliest;
  const double length = place_.belief().length();
  const double along = std::clamp(best.along, 0.0, length);
  const double outside = std::abs(best.along - along);
  if (last - first > kOnePlace) {
    nowhere_ = fmt::format(
        "from {} to {} along the route it looks alike: begin where more is near, or at the "
        "beginning",
        InWords(std::max(0.0, first)), InWords(std::min(length, last)));
    return;
  }
  if (outside > kOutside) {
    nowhere_ = fmt::format("what it sees is of the route, from {} {}: put it on the route",
                           InWords(outside),
                           best.along < along ? "before its beginning" : "beyond its end");
    return;
  }
  const RoutePoint point = place_.PointAt(along);
  if (focal_) search_.hand_over().KnowMagnification(best.magnification);
  const auto begun = BeginAbout(point) ? std::optional(along) : BeginBehind(best.by);
  if (!begun) return;
  place_.StartAt(*begun, std::max(kFound_m, last - first));
  came_m_ = kCome_m;
}

// Returns how unlikely it is that its camera has this focal length, given what turning has told, in
// features.
double FeatureFollower::Unlikely(const std::optional<replay::FocalLength>& focal) const {
  if (!focal || !focal_) return 0.0;
  return 0.25 * Square(std::log(focal->px / focal_->px) / std::hypot(focal->sigma, focal_->sigma));
}

// The features that tell the place need not be of the segment there: a narrow camera, and one that
// has turned to look around, sees what is further on. The robot begins by those, and is then
// counted along the path that leads there. Returns where that is along the route.
std::optional<double> FeatureFollower::BeginBehind(const RoutePoint& by) {
  if (!BeginBy(by)) return std::nullopt;
  const replay::FollowStep step = follower_->Step({front_end_.tracker().Current(), {{}}, {}});
  confidence_.SetFound();
  if (!step.offset) return place_.AlongOf({by.segment, step.fraction});
  const Eigen::Vector2d at(step.offset->along_m, step.offset->left_m);
  const auto behind =
      at.x() < 0.0 ? NearestBehind(route_, by.segment, at, at.norm() + kOnePlace) : std::nullopt;
  if (!behind) return place_.AlongOf({by.segment, 0.0}) + at.x();
  follower_->CountAlong(route_.segment(behind->segment), behind->along_m, behind->pose);
  search_.HandOverTo(*follower_);
  return place_.AlongOf({behind->segment, 0.0}) + behind->along_m;
}

// Late in a segment its features are leaving the picture, and the next one's are all there.
bool FeatureFollower::BeginAbout(const RoutePoint& point) {
  const std::size_t next = point.segment.value() + 1;
  return BeginBy(point) || (route_.has(next) && BeginBy({route_.segments()[next].index, 0.0}));
}

bool FeatureFollower::BeginBy(const RoutePoint& point) {
  const route::Segment& segment = route_.segment(point.segment);
  if (segment.features.empty()) return false;
  Make(segment);
  follower_->BeginAbout(segment, point.fraction, {kAlike_m, focal_});
  const auto found = search_.Recover(*follower_, segment, point);
  if (found.empty()) {
    follower_.reset();
    return false;
  }
  search_.TakeUpRecovered(found, *follower_, segment);
  return true;
}

bool FeatureFollower::IsElsewhereThanAtTheEnd() const {
  const double left = place_.belief().length() - place_.where().along;
  return place_.where().held && left > std::max(kEnd, kEndShare * place_.belief().length());
}

bool FeatureFollower::HasCome() const {
  return std::max(came_m_, place_.where().come) >= std::min(kCome_m, 0.5 * route_.length_m());
}

void FeatureFollower::EndSegment(Standing& standing) {
  const std::size_t next = follower_->segment().index.value() + 1;
  const double turn_rad = route_.turn_after_rad(follower_->segment().index);
  if (AsPrinted(options_.method) && std::abs(turn_rad) > kTurnsAway_rad) {
    standing = {ReplayState::kLost, Trust::kLost,
                fmt::format("the route turns on the spot here, by {:.0f} degrees, which the method "
                            "'{}' does not do: follow it by the method 'default'",
                            Degrees(turn_rad), ToString(options_.method))};
  } else if (route_.has(next)) {
    Begin(route_.segments()[next]);
  } else if (route_.complete() && !IsElsewhereThanAtTheEnd() && HasCome()) {
    standing.state = ReplayState::kArrived;
    standing.reason = "arrived at the end of the route";
  } else if (route_.complete()) {
    standing = {ReplayState::kLost, Trust::kLost,
                fmt::format("the last segment is over, but what is seen is {} before its end",
                            InWords(place_.belief().length() - place_.where().along))};
  } else {
    standing.state = ReplayState::kWaiting;
    standing.reason = fmt::format("waiting for segment {}: not received yet", next);
  }
}

}  // namespace trailcast::agent
