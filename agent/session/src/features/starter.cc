#include "agent/session/src/features/starter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "agent/session/src/place/path_ahead.h"
#include "services/base/angles.h"
#include "services/base/square.h"

namespace trailcast::agent {
namespace {

constexpr double kLensTurn_rad = 0.2;
constexpr double kFound_m = 0.3;
// A robot's stated place may be wrong by this much; so may a place among views that look alike
// apart from their size.
constexpr double kTold_m = 0.3;
constexpr double kAlike_m = 2.0;
// These are for places that look alike: how many are compared, and their least probability, and how
// often while the robot stands; how far before and behind each one it looks, in the route's units;
// and how many segments in one frame.
constexpr std::size_t kMostCompared = 6;
constexpr double kLeastCompared = 0.01;
constexpr double kCompare_s = 0.5;
constexpr double kLooksAlike = 20.0;
constexpr std::size_t kComparedAtOnce = 3;
constexpr int kEnoughHeld = 6;  // features, where the belief holds it to be there

// Returns how unlikely it is that a camera has this focal length, given what turning has told, in
// features.
double Unlikely(const std::optional<replay::FocalLength>& focal,
                const std::optional<replay::FocalLength>& told) {
  if (!focal || !told) return 0.0;
  return 0.25 * Square(std::log(focal->px / told->px) / std::hypot(focal->sigma, told->sigma));
}

replay::FollowStep StepOnTheSpot(replay::Follower& follower, const FrontEnd& front_end) {
  return follower.Step({front_end.tracker().Current(), {{}}, {}});
}

}  // namespace

Verdict TurnToLook(LookingAround& look_around, const FrameInput& seen, Verdict lost) {
  if (look_around.furthest_rad() == 0.0 || !seen.driven) return lost;
  if (look_around.Turn(seen.driven->heading_change_rad, seen.looked_s)) {
    return {Trust::kLooking, "turns on the spot to look for the path: " + lost.reason};
  }
  lost.reason += fmt::format("; nor is it found {:.0f} degrees to either side",
                             Degrees(look_around.furthest_rad()));
  return lost;
}

LensTurn::LensTurn(double furthest_rad) : turn_(std::min(kLensTurn_rad, furthest_rad)) {}

bool LensTurn::Turn(const std::vector<route::TrackedFeature>& seen, int width_px, double turned_rad,
                    double dt_s) {
  if (focal_ || turn_.furthest_rad() == 0.0) return false;
  if (flow_) {
    flow_->Look(seen, turned_rad);
  } else {
    flow_.emplace(width_px);
  }
  if (turn_.Turn(turned_rad, dt_s)) return true;
  focal_ = flow_->focal();
  return false;
}

Starter::Starter(const ReplayMethodOptions& options, int scout_width_px, const KnownRoute& route,
                 FrontEnd& front_end, Localiser& place, FeatureSearch& search,
                 LookingAround& look_around)
    : options_(options),
      scout_width_px_(scout_width_px),
      route_(route),
      front_end_(front_end),
      place_(place),
      search_(search),
      look_around_(look_around),
      lens_(look_around.furthest_rad()) {
  if (options.anywhere) phase_ = Anywhere{};
}

bool Starter::seeks_start() const {
  const auto* anywhere = std::get_if<Anywhere>(&phase_);
  return std::holds_alternative<WhereLeft>(phase_) ||
         (anywhere != nullptr && !anywhere->has_followed);
}

Starter::Outcome Starter::Step(const FrameInput& seen) {
  if (!lens_.focal() && options_.lens) {
    lens_.Know(
        replay::FocalLength{options_.lens->focal_share * seen.frame->width, options_.lens->sigma});
  }
  return std::visit([&](auto& phase) { return Look(phase, seen); }, phase_);
}

std::optional<Verdict> Starter::LookElsewhere(const std::optional<LostPath>& lost) {
  const auto* looks = std::get_if<Anywhere>(&phase_);
  // Our own method tells its place on the route by features, and can look again.
  const bool may =
      lost ? (options_.else_anywhere || options_.anywhere) && !AsPrinted(options_.method)
           : options_.else_anywhere && (looks == nullptr || looks->has_followed);
  if (!may) return std::nullopt;
  std::string not_there = lost ? "it has lost its path (" + lost->why + "): "
                          : std::holds_alternative<WhereLeft>(phase_)
                              ? "it is not where it was left: "
                              : "it is not at the route's start: ";
  if (lost) lens_.Know(lost->focal);
  fresh_.reset();
  search_.Forget();
  place_.StartAnywhere();
  Verdict seeks{Trust::kSeeking, not_there + "looks where on the route it is"};
  phase_ = Anywhere{std::move(not_there), lost.has_value()};
  return seeks;
}

const replay::Follower& Starter::Fresh(const route::Segment& first) {
  const WayBy way = !front_end_.knows_motion() || !first.has_odometry ? WayBy::kNothing
                    : !place_.metric()                                ? WayBy::kSight
                    : front_end_.has_odometry()                       ? WayBy::kOdometry
                                                                      : WayBy::kCommands;
  if (fresh_ && fresh_by_ == way) return *fresh_;
  const auto* at = std::get_if<WhereLeft>(&phase_);
  const auto known =
      at != nullptr && !at->finder.told() ? at->finder.left().magnification : std::nullopt;
  const double alike = static_cast<double>(search_.frame().width) / scout_width_px_;
  fresh_ = MakeFollower(options_, way, scout_width_px_, known.value_or(alike), known.has_value());
  fresh_by_ = way;
  const std::size_t learnt = std::min(route_.segments().size(), kMostLearnt);
  for (std::size_t i = 0; i < learnt; ++i) fresh_->Learn(route_.segments()[i]);
  return *fresh_;
}

Starter::Outcome Starter::Look(AtBeginning& /*phase*/, const FrameInput& /*seen*/) {
  const route::Segment& first = route_.segments().front();
  Begun begun{Fresh(first).Clone()};
  search_.Begin(*begun.follower, first);
  return begun;
}

Starter::Outcome Starter::Look(WhereLeft& phase, const FrameInput& seen) {
  PlaceFinder& finder = phase.finder;
  if (finder.told()) {
    if (auto turns = MeasureLens(seen, "")) return std::move(*turns);
    if (lens_.focal() && !finder.left().magnification) {
      finder.KnowMagnification(MagnificationBy(*lens_.focal()));
    }
  }
  const auto recognised_m =
      place_.where().held ? std::optional(place_.where().along) : std::nullopt;
  if (const auto found =
          finder.Look(search_.frame(), route_.segments(), search_.hand_over(), recognised_m)) {
    const route::Segment& segment = route_.segment(found->segment);
    Begun begun{Fresh(segment).Clone(), place_.AlongOf({found->segment, found->fraction}), true};
    if (finder.told()) {
      begun.follower->BeginAbout(segment, found->fraction, {kTold_m, lens_.focal()});
    } else {
      begun.follower->BeginAt(segment, found->fraction);
    }
    place_.StartAt(begun.along, kFound_m);
    search_.TakeUpWhereLeft(found->seen, *begun.follower);
    begun.recognised = recognised_m && std::abs(*recognised_m - place_.where().along) < kOtherPlace;
    return begun;
  }
  const std::string there =
      fmt::format("where it {}, {:.1f} m along the route",
                  finder.told() ? "is said to stand" : "was left", finder.left().along_m);
  if (!finder.given_up()) {
    return Next{
        {}, {lens_.begun() ? Trust::kLooking : Trust::kSeeking, "looks whether it is " + there}};
  }
  const char* elsewhere =
      finder.told() ? "nor within half a metre: " : "nor at the route's start: ";
  const char* what_to_do = finder.told()
                               ? "Put it there, or send it from where it stands"
                               : "Put it back to either, or begin at the start all the same with "
                                 "--from-start";
  Verdict lost{Trust::kLost, fmt::format("not {}, {}{} in view at best. {}", there, elsewhere,
                                         finder.MostSeen(), what_to_do)};
  return Next{{}, LookElsewhere(std::nullopt).value_or(std::move(lost))};
}

Starter::Outcome Starter::Look(Anywhere& phase, const FrameInput& seen) {
  const bool turned = lens_.turns();
  if (turned) {
    if (auto turns = MeasureLens(seen, phase.not_there)) return std::move(*turns);
  }
  const bool something = place_.where().held || place_.where().agreed >= kEnoughAgreed;
  Verdict verdict = phase.trust.Judge(place_.where(), seen.looked_s,
                                      "a place is recognised, but too few of its features");
  const bool lost = verdict.trust == Trust::kLost;
  Next next{{},
            {lost ? Trust::kLost : Trust::kSeeking,
             phase.not_there + "looks where on the route it is: " +
                 (phase.nowhere.empty() ? verdict.reason : phase.nowhere)}};
  if (seen.driven) phase.moved_m += std::abs(seen.driven->distance_m);
  if (phase.moved_m > kOnePlace || !something) phase.Forget();
  if (!phase.nowhere.empty()) return next;  // looking at the same until it fits would be guessing
  if (!lost) look_around_.Rest();
  if (!turned && something) {
    if (auto turns = MeasureLens(seen, phase.not_there)) return std::move(*turns);
  }
  phase.compare_at_s -= seen.looked_s;
  if (phase.to_compare.empty() && something && phase.compare_at_s <= kTimeSlack_s) {
    phase.compare_at_s = kCompare_s;
    phase.Forget();
    phase.to_compare = ToCompare();
  }
  if (!phase.to_compare.empty()) {
    CompareSome(phase);
    if (phase.to_compare.empty()) {
      if (Begun begun = BeginAtLikeliest(phase); begun.follower) return begun;
    }
  }
  // Neither does a robot give up that recognises nothing of the route: it looks around first.
  if (lost && phase.nowhere.empty()) {
    next.verdict = TurnToLook(look_around_, seen, std::move(next.verdict));
    next.step.command = {0.0, look_around_.turn_rate_radps()};
  }
  return next;
}

// Discards comparisons made before the robot moved.
void Starter::Anywhere::Forget() {
  to_compare.clear();
  compared.clear();
  nowhere.clear();
  moved_m = 0.0;
}

std::optional<Next> Starter::MeasureLens(const FrameInput& seen, const std::string& not_there) {
  if (!seen.measured) return std::nullopt;
  const bool begins = !lens_.begun();
  const double turned_rad = seen.measured->heading_change_rad;
  if (!lens_.Turn(seen.features, seen.frame->width, turned_rad, seen.looked_s)) return std::nullopt;
  if (begins) front_end_.tracker().Detect();
  Next next{{},
            {Trust::kLooking,
             not_there + "turns a little to either side to see how large its camera shows things"}};
  next.step.command = {0.0, lens_.turn_rate_radps()};
  return next;
}

// Returns the magnification that follows from the route's knowledge of the scout's camera.
double Starter::MagnificationBy(const replay::FocalLength& focal) {
  const replay::Follower& alike = Fresh(route_.segments().front());
  const auto its = alike.focal();
  return its ? alike.magnification() * focal.px / its->px : alike.magnification();
}

// Places apart can look alike, and views may be recognised from many metres further on. This
// returns the places where the robot may be and, if its camera is known, which makes the comparison
// cheap and tells near from far, every segment's beginning around them.
std::vector<RoutePoint> Starter::ToCompare() const {
  std::vector<double> places{place_.where().along};
  if (!place_.where().held) {
    places = place_.belief().Likeliest(kMostCompared, kLeastCompared, kAlike_m);
  }
  std::vector<RoutePoint> points;
  if (!lens_.focal()) {
    for (const double place : places) points.push_back(place_.PointAt(place));
    return points;
  }
  for (const route::Segment& segment : route_.segments()) {
    const double begins = place_.AlongOf({segment.index, 0.0});
    const auto is_near = [&](double place) { return std::abs(place - begins) < kLooksAlike; };
    if (std::any_of(places.begin(), places.end(), is_near)) points.push_back({segment.index, 0.0});
  }
  return points;
}

// Compares as many as one picture leaves time for: how many of a segment's features lie as a robot
// somewhere around there would see them, and from where.
void Starter::CompareSome(Anywhere& phase) {
  const HandOver unlearnt = search_.hand_over();
  const auto& focal = lens_.focal();
  const auto magnification = focal ? std::optional(MagnificationBy(*focal)) : std::nullopt;
  for (std::size_t i = 0; i < kComparedAtOnce && !phase.to_compare.empty(); ++i) {
    const RoutePoint point = phase.to_compare.back();
    phase.to_compare.pop_back();
    if (magnification) search_.hand_over().KnowMagnification(*magnification);
    if (const auto follower = focal ? BeginBy(point) : BeginAbout(point)) {
      phase.compared.push_back(SeenBy(*follower, point));
    }
    search_.hand_over() = unlearnt;
  }
  search_.Forget();
}

PlaceByFeatures Starter::SeenBy(replay::Follower& follower, const RoutePoint& from) const {
  const replay::FollowStep step = StepOnTheSpot(follower, front_end_);
  const RoutePoint there{follower.segment().index, step.fraction};
  PlaceByFeatures place{.along = place_.AlongOf(there)};
  place.by = there.segment == from.segment ? from : RoutePoint{there.segment, 0.0};
  if (step.offset && place_.metric()) {
    place.along = place_.AlongOf({there.segment, 0.0}) + step.offset->along_m;
    place.along_sigma = step.offset->along_sigma_m;
  }
  place.agreeing = step.agreeing;
  place.share = static_cast<double>(step.agreeing) / std::max(1, search_.InPicture(follower));
  place.magnification = follower.magnification();
  place.speaks = step.agreeing - Unlikely(follower.focal(), lens_.focal());
  return place;
}

// Begins at the likeliest of the compared places, if they are one place on the route.
Begun Starter::BeginAtLikeliest(Anywhere& phase) {
  const int enough = place_.where().held ? kEnoughHeld : kEnoughAgreed;
  const double length = place_.belief().length();
  Beginning beginning = BeginningBy(phase.compared, enough, {length, place_.metric()});
  phase.nowhere = std::move(beginning.nowhere);
  if (!beginning.place) return {};
  const auto& [best, first, last] = *beginning.place;
  const double along = std::clamp(best.along, 0.0, length);
  if (lens_.focal()) search_.hand_over().KnowMagnification(best.magnification);
  Begun begun{BeginAbout(place_.PointAt(along)), along};
  if (!begun.follower) begun = BeginBehind(best.by);
  if (!begun.follower) return {};
  begun.sought = true;
  begun.place_trust = phase.trust;
  begun.look_again_at_s = phase.compare_at_s;
  place_.StartAt(begun.along, std::max(kFound_m, last - first));
  return begun;
}

// The features that tell the place need not be of the segment there: a narrow camera, and one that
// has turned to look around, sees what is further on. The robot begins by those, and is then
// counted along the path that leads there.
Begun Starter::BeginBehind(const RoutePoint& by) {
  Begun begun{BeginBy(by)};
  if (!begun.follower) return {};
  begun.recognised = true;
  const replay::FollowStep step = StepOnTheSpot(*begun.follower, front_end_);
  if (!step.offset) {
    begun.along = place_.AlongOf({by.segment, step.fraction});
    return begun;
  }
  const Eigen::Vector2d at(step.offset->along_m, step.offset->left_m);
  const auto behind =
      at.x() < 0.0 ? NearestBehind(route_, by.segment, at, at.norm() + kOnePlace) : std::nullopt;
  if (!behind) {
    begun.along = place_.AlongOf({by.segment, 0.0}) + at.x();
    return begun;
  }
  begun.follower->CountAlong(route_.segment(behind->segment), behind->along_m, behind->pose);
  search_.HandOverTo(*begun.follower);
  begun.along = place_.AlongOf({behind->segment, 0.0}) + behind->along_m;
  return begun;
}

// Late in a segment its features are leaving the picture, and the next one's are all there.
std::unique_ptr<replay::Follower> Starter::BeginAbout(const RoutePoint& point) {
  if (auto follower = BeginBy(point)) return follower;
  const std::size_t next = point.segment.value() + 1;
  return route_.has(next) ? BeginBy({route_.segments()[next].index, 0.0}) : nullptr;
}

std::unique_ptr<replay::Follower> Starter::BeginBy(const RoutePoint& point) {
  const route::Segment& segment = route_.segment(point.segment);
  if (segment.features.empty()) return nullptr;
  auto follower = Fresh(segment).Clone();
  follower->BeginAbout(segment, point.fraction, {kAlike_m, lens_.focal()});
  const auto found = search_.Recover(*follower, segment, point);
  if (found.empty()) return nullptr;
  search_.TakeUpRecovered(found, *follower, segment);
  return follower;
}

}  // namespace trailcast::agent
