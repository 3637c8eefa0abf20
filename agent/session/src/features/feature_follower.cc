#include "agent/session/src/features/feature_follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/session/src/place/path_ahead.h"
#include "agent/session/src/place/view_follower.h"
#include "services/base/angles.h"
#include "services/belief/route_belief.h"

namespace trailcast::agent {
namespace {

// Blind robots look for the route again this often, since the wide search takes time.
constexpr double kLookAgain_s = 5.0 / 30.0;
// A robot that was carried and turned may be this far along its segment from where it was.
constexpr double kCarried_m = 1.0;
constexpr double kShareToSkip = 0.5;
constexpr double kApart = 0.5;  // in the route's units
// Features that move further than this from picture to picture, as a share of its width, are lost
// although nothing covers them.
constexpr double kRushes = 0.025;
// Views of other places agree in fewer features than this.
constexpr int kRecognised = 8;
constexpr int kGlimpsed = belief::RouteBeliefOptions{}.least_agreed;  // as for a held place
// If a robot that stands does not see something where it should be, it will not see it there later.
constexpr double kLookThere_s = 1.5;
constexpr double kLensTurn_rad = 0.2;

ConfidenceOptions ConfidenceOf(ReplayMethod method) {
  ConfidenceOptions options;
  options.stand_when_covered = !AsPrinted(method);
  return options;
}

}  // namespace

FeatureFollower::FeatureFollower(const ReplayMethodOptions& options,
                                 const vision::PictureSize& scout, const KnownRoute& route,
                                 FrontEnd& front_end, Localiser& place)
    : options_(options),
      scout_width_px_(scout.width),
      route_(route),
      front_end_(front_end),
      place_(place),
      search_(!AsPrinted(options.method), scout.width, front_end, place),
      confidence_(ConfidenceOf(options.method)),
      passing_(options.passing),
      look_around_(AsPrinted(options.method) ? 0.0 : options.look_around_rad),
      lens_turn_(std::min(kLensTurn_rad, look_around_.furthest_rad())),
      start_(options.anywhere ? Start::kAnywhere : Start::kAtBeginning) {
  if (options.take_experience && !AsPrinted(options.method)) {
    experience_.emplace(scout.width, scout.height);
  }
}

replay::FollowStep FeatureFollower::Step(const FrameInput& seen, Standing& standing) {
  const replay::FollowStep step = Steer(seen, standing);
  if (experience_ && follower_) {
    experience_->Look(seen, *follower_, front_end_.tracker().Current(),
                      standing.trust == Trust::kSure && !confidence_.recognised_only());
  }
  return step;
}

std::optional<refresh::Visit> FeatureFollower::TakeVisit() {
  if (!experience_ || !follower_) return std::nullopt;
  return experience_->Take(*follower_);
}

std::optional<OwnLens> FeatureFollower::lens() const {
  if (!follower_ || !confidence_.ever_sure()) return options_.lens;
  const auto focal = follower_->focal();
  if (!focal || frame_width_px_ == 0) return options_.lens;
  return OwnLens{focal->px / frame_width_px_, focal->sigma};
}

replay::FollowStep FeatureFollower::Steer(const FrameInput& seen, Standing& standing) {
  search_.Open(*seen.frame);
  frame_width_px_ = seen.frame->width;
  if (!focal_ && options_.lens) {
    focal_ = {options_.lens->focal_share * frame_width_px_, options_.lens->sigma};
  }
  if (const auto magnification = place_.Magnification(seen.frame->width)) {
    search_.hand_over().SetRunMagnification(*magnification);
  }
  replay::FollowStep step;
  if (!follower_ || standing.state == ReplayState::kWaiting) {
    if (!BeginNext(seen, standing)) return LookAroundForAny(seen, standing);
    step = follower_->Step({front_end_.tracker().Current(), seen.driven, seen.unknown});
    Judge(step, seen, standing);
  } else {
    step = follower_->turning() ? Turn(seen, standing) : Go(seen, standing);
  }
  const bool in_vain = !place_.where().held &&
                       (standing.trust == Trust::kLost || (standing.trust == Trust::kSeeking &&
                                                           confidence_.unsure_s() > kLookThere_s));
  if (in_vain && LooksElsewhere(standing)) return {};
  RefuseReverse(standing);
  return step;
}

// Refuses to drive backwards by a method that only drives forwards.
void FeatureFollower::RefuseReverse(Standing& standing) const {
  if (!AsPrinted(options_.method) || !follower_->segment().reverse) return;
  standing = {ReplayState::kLost, Trust::kLost,
              fmt::format("the route is driven backwards here, which the method '{}' does not do: "
                          "follow it by the method 'default'",
                          ToString(options_.method))};
}

// Turns on the spot before a segment, by odometry, and by the segment's features once they come
// into view. Then the robot has to be sure of them before it drives on.
replay::FollowStep FeatureFollower::Turn(const FrameInput& seen, Standing& standing) {
  const replay::FollowStep step = follower_->Step({seen.features, seen.driven, seen.unknown});
  const bool agrees =
      step.agreeing >= confidence_.options().min_features || place_.agreed_now() >= kEnoughAgreed;
  turns_unseen_s_ = agrees ? 0.0 : turns_unseen_s_ + seen.looked_s;
  if (turns_unseen_s_ <= confidence_.options().unsure_limit_s) {
    standing = {ReplayState::kFollowing, Trust::kSure, "turns on the spot"};
  } else {
    standing = {ReplayState::kBlind, Trust::kBlind, "turns on the spot, by odometry alone"};
  }
  place_.SetTracked(std::nullopt, 0);
  Sighting sighting;
  Compare({follower_->segment().index, 0.0}, sighting);
  if (sighting.elsewhere) {
    look_again_at_s_ = 0.0;
    LookAgain(0.0, true);
    return step;
  }
  if (follower_->turn_is_in_view()) {
    search_.Refresh(*follower_, step.agreeing, seen.looked_s, false);
  }
  if (follower_->turning()) return step;
  const route::Segment& segment = follower_->segment();
  search_.HandOverTo(*follower_);
  confidence_.SeekAnew(
      fmt::format("after turning on the spot by {:.0f} degrees the way on is not "
                  "found",
                  Degrees(std::abs(segment.turn_before_rad))));
  return step;
}

replay::FollowStep FeatureFollower::Go(const FrameInput& seen, Standing& standing) {
  const SegmentIndex before = follower_->segment().index;
  replay::FollowStep step =
      follower_->Step({seen.features, seen.driven, seen.unknown,
                       follower_->segment().reverse ? 0.0 : passing_.left_m()});
  Judge(step, seen, standing);
  const bool anew = follower_->segment().index != before;  // it has found itself elsewhere
  if (look_around_.turns()) step.command = {0.0, look_around_.turn_rate_radps()};
  if (follower_->segment().index == before) LookWhatStands(step, seen, standing);
  if (!AsPrinted(options_.method)) {
    search_.Refresh(*follower_, step.agreeing, seen.looked_s, step.carried_left_m.has_value());
  }
  if (anew) {
    step.ended = step.wants_next = false;
  } else if (step.offset && EndsAtTheAxle()) {
    step.ended = step.offset->along_m >= follower_->segment().length_m;
  }
  const bool next_is_here = route_.has(follower_->segment().index.value() + 1);
  // Whatever covers this segment's features covers the next one's too.
  const bool covered =
      standing.trust == Trust::kCovered || confidence_.view_is_going() || look_around_.turns();
  const bool wants_next = step.wants_next && next_is_here && !covered &&
                          !route_.stands_after(follower_->segment().index);
  if (standing.state != ReplayState::kLost && (step.ended || wants_next)) EndSegment(standing);
  // A segment that has just begun has less progress than the last one had.
  if (follower_->segment().index != before) {
    step.fraction = 0.0;
    if (step.offset) step.offset->along_m -= route_.segment(before).length_m;
  }
  if (confidence_.recognised_only()) SteerByWholeView(step);
  return step;
}

// Notes obstacles, for the next frame to steer by.
void FeatureFollower::LookWhatStands(const replay::FollowStep& step, const FrameInput& seen,
                                     const Standing& standing) {
  if (seen.stands == nullptr || !step.offset || follower_->segment().reverse) return;
  const SegmentIndex index = follower_->segment().index;
  const double along_m = step.offset->along_m;
  passing_.Look(*step.offset, route_.begin_m(index) + along_m, standing.trust == Trust::kSure,
                PathAheadOf(route_, index, along_m, options_.passing.look_ahead_m), *seen.stands);
}

// A segment is over once the camera is past it. But if the robot has to stop there, to turn on the
// spot or to drive on in the other direction, its axle has to get there.
bool FeatureFollower::EndsAtTheAxle() const {
  return route_.stands_after(follower_->segment().index);
}

// Returns how many of the segment's features should be in this frame.
int FeatureFollower::InPicture() const {
  const std::vector<route::TrackedFeature> places = follower_->Expect();
  const image::GrayImage& frame = search_.frame();
  return static_cast<int>(
      std::count_if(places.begin(), places.end(), [&](const route::TrackedFeature& place) {
        return std::abs(place.u_px) < 0.5 * frame.width &&
               std::abs(place.v_px) < 0.5 * frame.height;
      }));
}

Sighting FeatureFollower::SightOf(const replay::FollowStep& step, const FrameInput& seen) const {
  const route::Segment& segment = follower_->segment();
  Sighting sighting{segment.index.value(), static_cast<int>(segment.features.size()), step.agreeing,
                    seen.usual_flow < kRushes ? front_end_.tracker().losses().not_returned : 0};
  sighting.dt_s = seen.looked_s;
  sighting.carried_off = step.carried_left_m.has_value();
  if (step.offset) {
    sighting.left_sigma_m = step.offset->left_sigma_m;
    sighting.in_picture = InPicture();
  }
  Compare({segment.index, step.fraction}, sighting);
  return sighting;
}

// Compares the robot's estimated place, `point`, with the belief over the whole route.
void FeatureFollower::Compare(const RoutePoint& point, Sighting& sighting) const {
  if (!place_.where().held) return;
  // Another camera's views may be a little like those of a place some metres off.
  const bool drives = front_end_.drives();
  const double apart = std::abs(place_.where().along - place_.AlongOf(point));
  const bool here = apart <= (drives ? kElsewhereDriving : kElsewhere);
  const bool sees = AsPrinted(options_.method) || place_.agreed_now() >= kRecognised;
  const int enough = drives ? kEnoughAgreedDriving : kEnoughAgreed;
  sighting.elsewhere = !here && sees && place_.where().agreed >= enough;
  sighting.glimpsed = here && place_.agreed_now() >= kGlimpsed;
  // Robots that drive backwards are not steered by it: features beside the path then ask for the
  // wrong turn.
  sighting.recognised = here && options_.method == ReplayMethod::kDefault &&
                        !follower_->segment().reverse && place_.agreed_now() >= kRecognised;
}

void FeatureFollower::Judge(const replay::FollowStep& step, const FrameInput& seen,
                            Standing& standing) {
  Sighting sighting = SightOf(step, seen);
  // The belief is outweighed by as many features that lie where the taught geometry predicts them.
  sighting.elsewhere =
      sighting.elsewhere && (AsPrinted(options_.method) || place_.where().agreed > step.agreeing);
  const bool elsewhere = sighting.elsewhere;
  Verdict verdict = confidence_.Judge(sighting, seen.driven);
  if (AsPrinted(options_.method)) {  // the printed methods have no doubt of their own
    Verdict by_place = place_trust_.Judge(place_.where(), seen.looked_s);
    if (by_place.trust == Trust::kLost) verdict = std::move(by_place);
  }
  standing = {StateOf(verdict.trust), verdict.trust, std::move(verdict.reason)};
  NoteWay(step, standing);
  LookAroundFirst(seen, standing);
  // While odometry stands still, tracked features would hold the robot where it was.
  const bool tracked =
      standing.trust == Trust::kSure && step.offset && step.agreeing > 0 && !seen.frozen;
  const RoutePoint point{follower_->segment().index, step.fraction};
  // The place is fitted to the features, so a few of them agree with any place and do not count.
  place_.SetTracked(tracked ? std::optional(point) : std::nullopt,
                    std::max(0, step.agreeing - replay::kFewestAgreeing));
  const bool astray = standing.trust == Trust::kBlind || standing.trust == Trust::kSeeking ||
                      standing.trust == Trust::kLooking ||
                      (elsewhere && standing.trust == Trust::kUnsure) ||
                      confidence_.recognised_only();
  if (confidence_.unsure_s() == 0.0) look_again_at_s_ = kLookAgain_s;
  if (astray && standing.state != ReplayState::kLost) LookAgain(step.fraction, elsewhere);
}

void FeatureFollower::NoteWay(const replay::FollowStep& step, const Standing& standing) {
  std::optional<double> sure_along;
  if (standing.trust == Trust::kSure) {
    sure_along = place_.AlongOf({follower_->segment().index, step.fraction});
  }
  if (sure_along && sure_along_ && std::abs(*sure_along - *sure_along_) < kApart) {
    came_m_ += std::max(0.0, *sure_along - *sure_along_);
  }
  sure_along_ = sure_along;
}

// A robot that would give up because it does not see its path may have been turned away from it.
void FeatureFollower::LookAroundFirst(const FrameInput& seen, Standing& standing) {
  if (standing.trust != Trust::kLost || place_.where().held) look_around_.Rest();
  if (standing.trust != Trust::kLost || !confidence_.ever_sure() || place_.where().held) return;
  TurnToLook(seen, standing);
}

// Neither does a robot give up that may be anywhere on the route and recognises nothing of it: it
// looks around first.
replay::FollowStep FeatureFollower::LookAroundForAny(const FrameInput& seen, Standing& standing) {
  replay::FollowStep step;
  if (lens_turn_.turns()) step.command = {0.0, lens_turn_.turn_rate_radps()};
  if (!LooksAnywhere() || standing.trust != Trust::kLost || !nowhere_.empty()) return step;
  TurnToLook(seen, standing);
  step.command = {0.0, look_around_.turn_rate_radps()};
  return step;
}

void FeatureFollower::TurnToLook(const FrameInput& seen, Standing& standing) {
  if (look_around_.furthest_rad() == 0.0 || !seen.driven) return;
  if (look_around_.Turn(seen.driven->heading_change_rad, seen.looked_s)) {
    standing = {ReplayState::kBlind, Trust::kLooking,
                "turns on the spot to look for the path: " + standing.reason};
  } else {
    standing.reason += fmt::format("; nor is it found {:.0f} degrees to either side",
                                   Degrees(look_around_.furthest_rad()));
  }
}

// It looks where the belief holds the robot to be, if that is somewhere else. Otherwise it looks by
// turns there, around the estimated place, and at the next segment's start, since what is near may
// be gone for good.
void FeatureFollower::LookAgain(double fraction, bool elsewhere) {
  if (confidence_.unsure_s() + kTimeSlack_s < look_again_at_s_) return;
  const auto turn = static_cast<int>((confidence_.unsure_s() + kTimeSlack_s) / kLookAgain_s);
  look_again_at_s_ = (turn + 1) * kLookAgain_s;
  const SegmentIndex index = follower_->segment().index;
  const std::size_t next = index.value() + 1;
  const bool apart = place_.where().held &&
                     std::abs(place_.where().along - place_.AlongOf({index, fraction})) > kApart;
  const bool believed = elsewhere || (apart && turn % 3 == 2);
  const bool ahead = !believed && route_.has(next) && turn % 2 == 0 && !route_.stands_after(index);
  const RoutePoint point = believed ? place_.point()
                           : ahead  ? RoutePoint{route_.segments()[next].index, 0.0}
                                    : RoutePoint{index, fraction};
  const route::Segment& segment = route_.segment(point.segment);
  if (segment.features.empty()) return;
  const auto found = search_.Recover(*follower_, segment, point);
  // Features ahead may be visible from afar, so the robot only goes on from there if most of them
  // are.
  const bool too_far = ahead && static_cast<double>(found.size()) <
                                    kShareToSkip * static_cast<double>(segment.features.size());
  if (found.empty() || too_far) return;
  if (elsewhere && AsPrinted(options_.method)) {
    follower_->BeginAt(segment, point.fraction);
  } else if (believed || look_around_.turns()) {
    if (believed) came_m_ = 0.0;
    // Odometry does not know how far a robot was carried that was turned as well.
    follower_->BeginAbout(segment, point.fraction, {kCarried_m, follower_->focal()});
  } else if (ahead) {
    follower_->Begin(segment);
  }
  search_.TakeUpRecovered(found, *follower_, segment);
}

// Steers a robot that has lost the segment's features, where the view as a whole is recognised.
void FeatureFollower::SteerByWholeView(replay::FollowStep& step) const {
  const ViewSteering by_views = SteerByViews(
      place_, options_.speed_factor * follower_->segment().speed_mps(), options_.limits);
  if (by_views.turn.features == 0) return;
  step.turn_rad = step.vision_turn_rad = by_views.turn.turn_rad;
  step.command = by_views.command;
}

}  // namespace trailcast::agent
