// This judges how far a robot may be trusted that follows by features, and seeks them again.
#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/session/src/route_follower.h"
#include "services/belief/route_belief.h"

namespace trailcast::agent {
namespace {

// Blind robots look for the route again this often, since the wide search takes time.
constexpr double kLookAgain_s = 5.0 / 30.0;
// A robot that was carried and turned may be this far along its segment from where it was.
constexpr double kCarried_m = 1.0;
constexpr double kShareToSkip = 0.5;
constexpr double kApart = 0.5;             // in the route's units
constexpr double kElsewhereDriving = 2.0;  // for a robot that the belief moves
constexpr int kEnoughAgreedDriving = 15;
// Features that move further than this from picture to picture, as a share of its width, are lost
// although nothing covers them.
constexpr double kRushes = 0.025;
// Views of other places agree in fewer features than this.
constexpr int kRecognised = 8;
constexpr int kGlimpsed = belief::RouteBeliefOptions{}.least_agreed;  // as for a held place

}  // namespace

// Returns what the belief over the whole route says of a robot that takes itself to be at that
// fraction of its segment.
Sighting RouteFollower::Believed(double fraction) const {
  const route::Segment& segment = follower_->segment();
  Sighting sighting{segment.index.value(), static_cast<int>(segment.features.size())};
  const belief::RouteBelief::Place& where = place_.where();
  if (!where.held) return sighting;
  // Another camera's views may be a little like those of a place some metres off.
  const bool drives = front_end_.drives();
  const double apart = std::abs(where.along - place_.AlongOf({segment.index, fraction}));
  const bool here = apart <= (drives ? kElsewhereDriving : kOtherPlace);
  const int agreed = place_.agreed_now();
  const bool sees = AsPrinted(options_.method) || agreed >= kRecognised;
  sighting.elsewhere =
      !here && sees && where.agreed >= (drives ? kEnoughAgreedDriving : kEnoughAgreed);
  sighting.glimpsed = here && agreed >= kGlimpsed;
  // Robots that drive backwards are not steered by it: features beside the path then ask for the
  // wrong turn.
  sighting.recognised = here && options_.method == ReplayMethod::kDefault && !segment.reverse &&
                        agreed >= kRecognised;
  return sighting;
}

Sighting RouteFollower::SightingOf(const replay::FollowStep& step, const FrameInput& seen) const {
  Sighting sighting = Believed(step.fraction);
  // The belief is outweighed by as many features that lie where the taught geometry predicts them.
  if (!AsPrinted(options_.method) && place_.where().agreed <= step.agreeing) {
    sighting.elsewhere = false;
  }
  sighting.agreeing = step.agreeing;
  if (seen.usual_flow < kRushes) sighting.vanished = front_end_.tracker().losses().not_returned;
  sighting.dt_s = seen.looked_s;
  sighting.carried_off = step.carried_left_m.has_value();
  if (step.offset) {
    sighting.left_sigma_m = step.offset->left_sigma_m;
    sighting.in_picture = search_.InPicture(*follower_);
  }
  return sighting;
}

// Returns how far the robot may be trusted that made this step, and tells the belief and the search
// what follows from that.
Verdict RouteFollower::Judge(const replay::FollowStep& step, const FrameInput& seen) {
  const Sighting sighting = SightingOf(step, seen);
  Verdict verdict = confidence_.Judge(sighting, seen.driven);
  if (AsPrinted(options_.method)) {  // the printed methods have no doubt of their own
    Verdict by_place = place_trust_.Judge(place_.where(), seen.looked_s);
    if (by_place.trust == Trust::kLost) verdict = std::move(by_place);
  }
  const RoutePoint point{follower_->segment().index, step.fraction};
  const bool sure = verdict.trust == Trust::kSure;
  const auto sure_along = sure ? std::optional(place_.AlongOf(point)) : std::nullopt;
  if (sure_along && sure_along_ && std::abs(*sure_along - *sure_along_) < kApart) {
    came_m_ += std::max(0.0, *sure_along - *sure_along_);
  }
  sure_along_ = sure_along;
  // A robot that would give up because it does not see its path may have been turned away from it.
  const bool gives_up = verdict.trust == Trust::kLost && !place_.where().held;
  if (!gives_up) look_around_.Rest();
  if (gives_up && confidence_.ever_sure()) {
    verdict = TurnToLook(look_around_, seen, std::move(verdict));
  }
  // While odometry stands still, tracked features would hold the robot where it was.
  const bool tracked = sure && step.offset && step.agreeing > 0 && !seen.frozen;
  // The place is fitted to the features, so a few of them agree with any place and do not count.
  place_.SetTracked(tracked ? std::optional(point) : std::nullopt,
                    std::max(0, step.agreeing - replay::kFewestAgreeing));
  const Trust trust = verdict.trust;
  const bool astray = trust == Trust::kBlind || trust == Trust::kSeeking ||
                      trust == Trust::kLooking || (sighting.elsewhere && trust == Trust::kUnsure) ||
                      confidence_.recognised_only();
  if (confidence_.unsure_s() == 0.0) look_again_at_s_ = kLookAgain_s;
  if (astray && trust != Trust::kLost) LookAgain(step.fraction, sighting.elsewhere);
  return verdict;
}

// It looks where the belief holds the robot to be, if that is somewhere else. Otherwise it looks by
// turns there, around the estimated place, and at the next segment's start, since what is near may
// be gone for good.
void RouteFollower::LookAgain(double fraction, bool elsewhere) {
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

}  // namespace trailcast::agent
