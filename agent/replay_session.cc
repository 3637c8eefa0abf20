#include "agent/replay_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "agent/confidence.h"
#include "agent/frame_check.h"
#include "agent/hand_over.h"
#include "agent/place_keeper.h"
#include "agent/place_trust.h"
#include "agent/view_follower.h"
#include "services/vision/donut.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {
namespace {

constexpr double kUncertainSpeedFactor = 0.6;
// Blind robots look for the route again every so many frames: the wide search costs time.
constexpr int kLookAgain_frames = 5;
constexpr double kShareToSkip = 0.5;
// With a smaller share of the segment's features than this they are sought again, every so often.
constexpr double kEnoughShare = 0.5;
constexpr int kRefresh_frames = 6;
// What so many segments say of the scout's camera is enough; each costs a fraction of a
// millisecond.
constexpr std::size_t kMostLearnt = 200;

// The route's end is approached ever more slowly, so that the robot stands where it is reached.
constexpr double kEndDeceleration_mps2 = 0.25;
constexpr double kEndSpeed_mps = 0.08;

// How many of these places, from the image centre, are in the picture.
std::ptrdiff_t InPicture(const std::vector<route::TrackedFeature>& places,
                         const image::GrayImage& frame) {
  return std::count_if(places.begin(), places.end(), [&](const route::TrackedFeature& place) {
    return std::abs(place.u_px) < 0.5 * frame.width && std::abs(place.v_px) < 0.5 * frame.height;
  });
}

// How far most features moved between two frames, as a share of the picture's width.
double Flow(const std::vector<route::TrackedFeature>& before,
            const std::vector<route::TrackedFeature>& now, int width_px) {
  std::vector<double> moved;
  std::size_t i = 0;
  for (const route::TrackedFeature& feature : now) {
    while (i < before.size() && before[i].id != feature.id) ++i;
    if (i == before.size()) break;
    moved.push_back(std::hypot(feature.u_px - before[i].u_px, feature.v_px - before[i].v_px));
  }
  if (moved.size() < 4) return 1.0;
  const auto middle = moved.begin() + std::ssize(moved) / 2;
  std::nth_element(moved.begin(), middle, moved.end());
  return *middle / width_px;
}

constexpr int kMostWithoutPicture_frames = 90;
// How far from the route's start a robot may be that is put there, in the route's units.
constexpr double kStart_sigma = 0.25;
constexpr double kLeft_m = 0.5;  // and from where it was left
constexpr double kFound_m = 0.3;
// The belief holds the robot to be somewhere else than its features do.
constexpr double kElsewhere = 2.0;
constexpr int kEnoughAgreed = 10;
// How much of a route may be left where a method says that it has arrived.
constexpr double kEnd = 2.0;
constexpr double kEndShare = 0.05;
constexpr const char* kOnlyTheEnd =
    "what is seen looks like the route's end, where the robot was put and has not come by itself: "
    "put it further back";

}  // namespace

struct ReplaySession::State {
  State(const ReplayMethodOptions& method, const route::RouteInfo& route)
      : options(method),
        scout_width_px(route.image_width_px),
        announced_segments(route.segment_count),
        place(scout_width_px),
        view_follower(method),
        hand_over(!AsPrinted(method.method), scout_width_px) {}

  ReplayMethodOptions options;
  int scout_width_px = 0;
  std::size_t announced_segments = 0;  // of the route; not all of them may have come yet
  std::vector<route::Segment> segments;
  std::vector<double> begin_m;  // of each segment, along the route
  bool complete = false;

  FrameCheck check;
  vision::DonutUnroller unroller;
  vision::FeatureTracker tracker;
  PlaceKeeper place;
  ViewFollower view_follower;
  HandOver hand_over;
  std::optional<PlaceFinder> place_finder;     // until it has found the place
  std::unique_ptr<replay::Follower> follower;  // made when the first segment begins
  std::optional<motion::Pose2> last_odometry;
  std::optional<SensorTime> last_stamp;
  ReplayState state = ReplayState::kWaiting;
  std::string reason;
  int frames_since_find = 0;
  Confidence confidence;
  PlaceTrust place_trust;  // of the printed methods
  Trust trust = Trust::kSeeking;
  std::vector<Search> searches;  // in this frame
  int frames_without_picture = 0;
  bool begun = false;  // a frame was seen while something of the route was known
  ReplayStep last_report;

  [[nodiscard]] double known_m() const {
    return segments.empty() ? 0.0 : begin_m.back() + segments.back().length_m;
  }
  [[nodiscard]] double ProgressAt(SegmentIndex segment, double fraction) const {
    return (segment.value() + fraction) /
           static_cast<double>(std::max(segments.size(), announced_segments));
  }
  [[nodiscard]] std::optional<motion::OdometryIncrement> OdometryStep(
      const Observation& observation);
  [[nodiscard]] ReplayStep StepWithoutPicture(const std::string& why);
  void BeginPlace(const image::GrayImage& frame);
  void Look(const image::GrayImage& frame);
  [[nodiscard]] bool ByViews() const;
  [[nodiscard]] ReplayStep StepByViews(const image::GrayImage& frame);
  [[nodiscard]] ReplayStep StepByFeatures(const image::GrayImage& frame,
                                          const std::vector<route::TrackedFeature>& tracked,
                                          const std::optional<motion::OdometryIncrement>& odometry);
  void MakeFollower(const image::GrayImage& frame, const route::Segment& first);
  void Begin(std::size_t index, const image::GrayImage& frame);
  void SeekFeatures(const image::GrayImage& frame);
  [[nodiscard]] ReplayStep Turn(const image::GrayImage& frame,
                                const std::optional<motion::OdometryIncrement>& odometry);
  [[nodiscard]] bool BeginNext(const image::GrayImage& frame);
  [[nodiscard]] bool BeginWhereLeft(const image::GrayImage& frame);
  [[nodiscard]] bool BeginAnywhere(const image::GrayImage& frame);
  [[nodiscard]] bool IsElsewhereThanAtTheEnd() const;
  void EndSegment(const image::GrayImage& frame);
  void Follow(const std::vector<route::TrackedFeature>& found);
  void LookAgain(const image::GrayImage& frame, double fraction, bool elsewhere);
  void Refresh(const image::GrayImage& frame, const replay::FollowStep& step);
  void Compare(const RoutePoint& point, Sighting& seen) const;
  void JudgeSight(const replay::FollowStep& step,
                  const std::optional<motion::OdometryIncrement>& odometry,
                  const image::GrayImage& frame);
  void SteerByViews(replay::FollowStep& step) const;
  [[nodiscard]] double SpeedShare(const replay::FollowStep& step) const;
  [[nodiscard]] ReplayStep Report(const replay::FollowStep& step) const;
};

std::optional<motion::OdometryIncrement> ReplaySession::State::OdometryStep(
    const Observation& observation) {
  std::optional<motion::OdometryIncrement> step;
  if (observation.odometry && last_odometry) {
    step = motion::IncrementBetween(*last_odometry, *observation.odometry);
  } else if (observation.odometry) {
    step = motion::OdometryIncrement{};
  }
  last_odometry = observation.odometry;
  return step;
}

// A camera that gives nothing to look at: the robot stands, for a while.
ReplayStep ReplaySession::State::StepWithoutPicture(const std::string& why) {
  if (state == ReplayState::kArrived || state == ReplayState::kLost) return last_report;
  ReplayStep report = last_report;
  const bool lost = ++frames_without_picture > kMostWithoutPicture_frames;
  report.command = {};
  report.state = lost ? ReplayState::kLost : ReplayState::kBlind;
  report.trust = lost ? Trust::kLost : Trust::kBlind;
  report.reason = why;
  trust = report.trust;
  if (lost) {
    state = report.state;
    last_report = report;
  }
  return report;
}

void ReplaySession::State::BeginPlace(const image::GrayImage& frame) {
  begun = true;
  if (place_finder) {
    const double magnification = place_finder->left().magnification;
    hand_over.KnowMagnification(magnification);
    place.KnowMagnification(magnification, frame.width);
    place.StartAt(place_finder->left().along_m, kLeft_m);
  } else if (options.anywhere) {
    place.StartAnywhere();
  } else {
    place.StartAt(0.0, kStart_sigma);
  }
}

// Without odometry, in the route or on the robot, our own method goes by what is recognised.
bool ReplaySession::State::ByViews() const {
  return options.method == ReplayMethod::kDefault &&
         !(last_odometry && segments.front().has_odometry);
}

ReplayStep ReplaySession::State::StepByViews(const image::GrayImage& frame) {
  place.LookAt(frame);
  const route::Segment& here = segments[place.point().segment.value()];
  const double speed_mps = here.has_odometry ? here.speed_mps() : replay::kSpeedWithoutOdometry_mps;
  const bool end_is_seen = ViewFollower::SeesTheEnd(place);
  const bool end_is_reached = end_is_seen && ViewFollower::HasCome(place);
  ReplayStep report =
      view_follower.Step(place, options.speed_factor * speed_mps,
                         complete && end_is_seen && !end_is_reached ? kOnlyTheEnd : "");
  report.progress = ProgressAt(report.segment, report.fraction);
  if (complete ? end_is_reached : end_is_seen) {
    report.command = {};
    report.segment = segments.back().index;
    report.fraction = 1.0;
    report.progress = ProgressAt(report.segment, report.fraction);
    report.state = complete ? ReplayState::kArrived : ReplayState::kWaiting;
    report.reason = complete
                        ? "arrived at the end of the route"
                        : fmt::format("waiting for segment {}: not received yet", segments.size());
  }
  state = report.state;
  trust = report.trust;
  tracker.Detect();  // whose flow tells whether the robot moves
  return report;
}

void ReplaySession::State::MakeFollower(const image::GrayImage& frame,
                                        const route::Segment& first) {
  const double magnification = place_finder ? place_finder->left().magnification
                                            : static_cast<double>(frame.width) / scout_width_px;
  follower = agent::MakeFollower(options, last_odometry.has_value() && first.has_odometry,
                                 scout_width_px, magnification, place_finder.has_value());
  const std::size_t known = std::min(segments.size(), kMostLearnt);
  for (std::size_t i = 0; i < known; ++i) follower->Learn(segments[i]);
}

// Hand-over: the segment's stored features are found in this frame and followed from here.
void ReplaySession::State::Begin(std::size_t index, const image::GrayImage& frame) {
  const route::Segment& segment = segments[index];
  if (!follower) MakeFollower(frame, segment);
  follower->Begin(segment);
  if (follower->turning()) {  // what it is to find is not in view yet
    tracker.Follow({});
    return;
  }
  SeekFeatures(frame);
}

void ReplaySession::State::SeekFeatures(const image::GrayImage& frame) {
  const route::Segment& segment = follower->segment();
  Follow(hand_over.ToSegment(frame, *follower, [&] {
    return place.Recognise(frame, {segment.index, 0.0});
  }));
  searches.push_back(
      SearchOf(SearchKind::kHandOver, segment, tracker.count(), hand_over.last_was_wide()));
  frames_since_find = 0;
}

// False: it has not found the place, yet or at all.
bool ReplaySession::State::BeginWhereLeft(const image::GrayImage& frame) {
  const auto recognised_m = place.where().held ? std::optional(place.where().along) : std::nullopt;
  if (const auto found = place_finder->Look(frame, segments, hand_over, recognised_m)) {
    const route::Segment& segment = segments[found->segment.value()];
    MakeFollower(frame, segment);
    follower->BeginAt(segment, found->fraction);
    place.StartAt(place.AlongOf({found->segment, found->fraction}), kFound_m);
    hand_over.TakeUp(found->seen, *follower);
    Follow(found->seen.features);
    searches.push_back(SearchOf(SearchKind::kRecovered, segment, tracker.count(), false));
    place_finder.reset();
    if (recognised_m && std::abs(*recognised_m - place.where().along) < kElsewhere) {
      confidence.SetFound();
    }
    return true;
  }
  state = ReplayState::kBlind;
  const double left_m = place_finder->left().along_m;
  reason = fmt::format("looks whether it is where it was left, {:.1f} m along the route", left_m);
  if (!place_finder->given_up()) return false;
  state = ReplayState::kLost;
  trust = Trust::kLost;
  reason = fmt::format(
      "not where it was left, {:.1f} m along the route, nor at the route's start: {} in view at "
      "best. Put it back to either, or begin at the start all the same with --from-start",
      left_m, place_finder->MostSeen());
  return false;
}

// The same, of one that may be anywhere on the route.
bool ReplaySession::State::BeginAnywhere(const image::GrayImage& frame) {
  Verdict verdict = place_trust.Judge(place.where());
  state = verdict.trust == Trust::kLost ? ReplayState::kLost : ReplayState::kBlind;
  trust = verdict.trust == Trust::kLost ? Trust::kLost : Trust::kSeeking;
  reason = "looks where on the route it is: " + verdict.reason;
  const RoutePoint point = place.point();
  const route::Segment& segment = segments[point.segment.value()];
  if (!place.where().held || segment.features.empty()) return false;
  MakeFollower(frame, segment);
  follower->BeginAt(segment, point.fraction);
  const auto found =
      hand_over.Recover(frame, *follower, segment, point.fraction, place.Recognise(frame, point));
  if (found.empty()) {
    follower.reset();
    return false;
  }
  Follow(found);
  searches.push_back(SearchOf(SearchKind::kRecovered, segment, tracker.count(), true));
  return true;
}

// Of a robot that stands, for want of a segment to follow. False: there is none yet.
bool ReplaySession::State::BeginNext(const image::GrayImage& frame) {
  if (place_finder) return BeginWhereLeft(frame);
  if (options.anywhere && !follower) return BeginAnywhere(frame);
  const std::size_t next = follower ? follower->segment().index.value() + 1 : 0;
  if (next < segments.size()) {
    Begin(next, frame);
    return true;
  }
  if (complete && follower) state = ReplayState::kArrived;
  return false;
}

bool ReplaySession::State::IsElsewhereThanAtTheEnd() const {
  const double left = place.belief().length() - place.where().along;
  return place.where().held && left > std::max(kEnd, kEndShare * place.belief().length());
}

void ReplaySession::State::EndSegment(const image::GrayImage& frame) {
  const std::size_t next = follower->segment().index.value() + 1;
  if (next < segments.size()) {
    Begin(next, frame);
  } else if (complete && !IsElsewhereThanAtTheEnd()) {
    state = ReplayState::kArrived;
    reason = "arrived at the end of the route";
  } else if (complete) {
    state = ReplayState::kLost;
    trust = Trust::kLost;
    reason = fmt::format("the last segment is over, but what is seen is {:.1f} {} before its end",
                         place.belief().length() - place.where().along,
                         place.metric() ? "m" : "s of teaching");
  } else {
    state = ReplayState::kWaiting;
    reason = fmt::format("waiting for segment {}: not received yet", next);
  }
}

// A window that grows with the magnification keeps features longer, some of them while they slide
// off. The estimator by odometry tells those; the funnel lane does not, and is better off when they
// are lost and sought again (0.58 instead of 0.81 of the turns right on a recording at 2.6 times).
void ReplaySession::State::Follow(const std::vector<route::TrackedFeature>& found) {
  if (last_odometry) tracker.SetMagnification(follower->magnification());
  tracker.Follow(found);
}

// Where the belief holds it to be, if that is somewhere else; otherwise about where it is thought
// to be and at the next segment's start, by turns: what is near may be gone for good.
void ReplaySession::State::LookAgain(const image::GrayImage& frame, double fraction,
                                     bool elsewhere) {
  if (confidence.unsure_frames() % kLookAgain_frames != 0) return;
  const SegmentIndex index = follower->segment().index;
  const std::size_t next = index.value() + 1;
  const bool ahead = !elsewhere && next < segments.size() &&
                     confidence.unsure_frames() / kLookAgain_frames % 2 == 0;
  const RoutePoint point = elsewhere ? place.point()
                           : ahead   ? RoutePoint{segments[next].index, 0.0}
                                     : RoutePoint{index, fraction};
  const route::Segment& segment = segments[point.segment.value()];
  if (segment.features.empty()) return;
  const auto found =
      hand_over.Recover(frame, *follower, segment, point.fraction, place.Recognise(frame, point));
  // What is ahead may be seen from afar: to go on from there, most of it must be.
  const bool too_far = ahead && static_cast<double>(found.size()) <
                                    kShareToSkip * static_cast<double>(segment.features.size());
  if (found.empty() || too_far) return;
  if (elsewhere) follower->BeginAt(segment, point.fraction);
  if (ahead) follower->Begin(segment);
  Follow(found);
  searches.push_back(SearchOf(SearchKind::kRecovered, segment, tracker.count(), true));
}

// Features once lost (blur, a passer-by) come back into view, and to a robot that was carried off
// they are elsewhere: look for them again.
void ReplaySession::State::Refresh(const image::GrayImage& frame, const replay::FollowStep& step) {
  const route::Segment& segment = follower->segment();
  const bool few = step.agreeing < kEnoughShare * static_cast<double>(segment.features.size());
  const bool due = ++frames_since_find >= kRefresh_frames && few;
  if (AsPrinted(options.method) || (!due && !step.carried_left_m)) return;
  frames_since_find = 0;
  std::vector<route::TrackedFeature> found = hand_over.Again(frame, *follower);
  if (static_cast<int>(found.size()) <= step.agreeing) return;
  tracker.Follow(found);
  searches.push_back(SearchOf(SearchKind::kLookedAgain, segment, tracker.count(), false));
}

// By the belief over the whole route, of a robot that is thought to be at `point`.
void ReplaySession::State::Compare(const RoutePoint& point, Sighting& seen) const {
  if (!place.where().held) return;
  const bool here = std::abs(place.where().along - place.AlongOf(point)) <= kElsewhere;
  seen.elsewhere = !here && place.where().agreed >= kEnoughAgreed;
  seen.recognised =
      here && options.method == ReplayMethod::kDefault && place.agreed_now() >= kEnoughAgreed;
}

void ReplaySession::State::JudgeSight(const replay::FollowStep& step,
                                      const std::optional<motion::OdometryIncrement>& odometry,
                                      const image::GrayImage& frame) {
  const route::Segment& segment = follower->segment();
  const RoutePoint point{segment.index, step.fraction};
  Sighting seen{segment.index.value(), static_cast<int>(segment.features.size()), step.agreeing,
                tracker.losses().not_returned};
  seen.carried_off = step.carried_left_m.has_value();
  if (step.offset) {
    seen.left_sigma_m = step.offset->left_sigma_m;
    seen.in_picture = static_cast<int>(InPicture(follower->Expect(), frame));
  }
  Compare(point, seen);
  // Features that lie where odometry and the taught geometry have them outweigh it.
  const bool elsewhere = seen.elsewhere;
  seen.elsewhere = elsewhere && AsPrinted(options.method);
  Verdict verdict = confidence.Judge(seen, odometry);
  if (AsPrinted(options.method)) {  // which know no doubt of their own
    Verdict by_place = place_trust.Judge(place.where());
    if (by_place.trust == Trust::kLost) verdict = std::move(by_place);
  }
  trust = verdict.trust;
  state = StateOf(trust);
  reason = std::move(verdict.reason);
  const bool tracked = trust == Trust::kSure && step.offset && step.agreeing > 0;
  place.SetTracked(tracked ? std::optional(point) : std::nullopt, step.agreeing);
  const bool astray = trust == Trust::kBlind || trust == Trust::kSeeking ||
                      (elsewhere && trust == Trust::kUnsure) || confidence.recognised_only();
  if (astray && state != ReplayState::kLost) LookAgain(frame, step.fraction, elsewhere);
}

// Share of the method's speed that is driven: less when it is not known how far beside the path
// the robot is, and before the route's end.
double ReplaySession::State::SpeedShare(const replay::FollowStep& step) const {
  const double share =
      trust == Trust::kBlind || trust == Trust::kDistant ? kUncertainSpeedFactor : 1.0;
  const route::Segment& segment = follower->segment();
  const bool last = complete && segment.index.value() + 1 == segments.size();
  if (AsPrinted(options.method) || !last || step.command.linear_mps <= 0.0) {
    return share;
  }
  const double left_m = (1.0 - step.fraction) * segment.length_m;
  const double bound_mps = kEndSpeed_mps + std::sqrt(2.0 * kEndDeceleration_mps2 * left_m);
  return std::min(share, bound_mps / step.command.linear_mps);
}

// The belief goes along: where the features are lost, it says where to look for them.
void ReplaySession::State::Look(const image::GrayImage& frame) {
  if (trust == Trust::kSure && !place.LookIsDue()) return;
  place.LookAt(frame);
  if (const auto magnification = place.Magnification(frame.width)) {
    hand_over.SetRunMagnification(*magnification);
  }
}

// Of a robot that has lost the segment's features, where the view as a whole is recognised.
void ReplaySession::State::SteerByViews(replay::FollowStep& step) const {
  const ViewFollower::Steering by_views =
      view_follower.Steer(place, options.speed_factor * follower->segment().speed_mps());
  if (by_views.turn.features == 0) return;
  step.turn_rad = step.vision_turn_rad = by_views.turn.turn_rad;
  step.command = by_views.command;
}

// On the spot, before a segment: as far as odometry says.
ReplayStep ReplaySession::State::Turn(const image::GrayImage& frame,
                                      const std::optional<motion::OdometryIncrement>& odometry) {
  const replay::FollowStep step = follower->Step({{}, odometry});
  trust = Trust::kSure;
  state = ReplayState::kFollowing;
  reason.clear();
  if (!follower->turning()) SeekFeatures(frame);
  return Report(step);
}

ReplayStep ReplaySession::State::StepByFeatures(
    const image::GrayImage& frame, const std::vector<route::TrackedFeature>& tracked,
    const std::optional<motion::OdometryIncrement>& odometry) {
  Look(frame);
  if (!follower || state == ReplayState::kWaiting) {
    if (!BeginNext(frame)) return Report({});
    const replay::FollowStep first = follower->Step({tracker.Current(), odometry});
    JudgeSight(first, odometry, frame);
    return Report(first);
  }
  if (follower->turning()) return Turn(frame, odometry);
  const SegmentIndex segment_before = follower->segment().index;
  replay::FollowStep step = follower->Step({tracked, odometry});
  JudgeSight(step, odometry, frame);
  Refresh(frame, step);
  const bool next_is_here = follower->segment().index.value() + 1 < segments.size();
  // What covers this segment's features covers the next one's too.
  const bool covered = trust == Trust::kCovered || confidence.view_is_going();
  const bool wants_next = step.wants_next && next_is_here && !covered;
  if (state != ReplayState::kLost && (step.ended || wants_next)) EndSegment(frame);
  // A segment that has just begun is not as far along as the last one was.
  if (follower->segment().index != segment_before) {
    step.fraction = 0.0;
    if (step.offset) step.offset->along_m -= segments[segment_before.value()].length_m;
  }
  if (confidence.recognised_only()) SteerByViews(step);
  return Report(step);
}

ReplayStep ReplaySession::State::Report(const replay::FollowStep& step) const {
  ReplayStep report;
  report.state = state;
  report.trust = trust;
  report.sight = {0, tracker.losses(), searches};
  report.reason = reason;
  report.found_share = hand_over.found_share();
  report.hand_overs = hand_over.count();
  report.features = tracker.count();
  if (!follower) return report;
  report.segment = follower->segment().index;
  report.sight.stored = static_cast<int>(follower->segment().features.size());
  report.magnification = follower->magnification();
  report.fraction = state == ReplayState::kArrived ? 1.0 : step.fraction;
  report.progress = ProgressAt(report.segment, report.fraction);
  if (confidence.ever_sure() && follower->segment().has_odometry) {
    // A segment's start may still be ahead: its features are followed as soon as they are in view.
    const double length_m = follower->segment().length_m;
    const double along_m =
        step.offset ? std::min(step.offset->along_m, length_m) : report.fraction * length_m;
    report.along_m = std::max(0.0, begin_m[report.segment.value()] + along_m);
    if (state == ReplayState::kArrived) report.along_m = known_m();
  }
  report.turn_rad = step.turn_rad;
  report.decision = step;
  const bool on_by_odometry = state == ReplayState::kBlind && trust == Trust::kBlind &&
                              last_odometry && UsesOdometry(options.method);
  if (state == ReplayState::kFollowing || on_by_odometry) {
    const double share = SpeedShare(step);
    report.command = {share * step.command.linear_mps, share * step.command.angular_radps};
  }
  return report;
}

ReplaySession::ReplaySession(const ReplayMethodOptions& options, const route::RouteInfo& route)
    : state_(std::make_unique<State>(options, route)) {
  ConfidenceOptions confidence;
  confidence.stand_when_covered = !AsPrinted(options.method);
  state_->confidence = Confidence(confidence);
}

ReplaySession::~ReplaySession() = default;
ReplaySession::ReplaySession(ReplaySession&&) noexcept = default;
ReplaySession& ReplaySession::operator=(ReplaySession&&) noexcept = default;

Result<void> ReplaySession::AddSegment(route::Segment segment) {
  if (segment.index.value() != state_->segments.size()) {
    return Fail(ErrorCode::kInvalidArgument, "segment {} was given where {} comes next",
                segment.index.value(), state_->segments.size());
  }
  if (state_->follower && state_->segments.size() < kMostLearnt) state_->follower->Learn(segment);
  state_->begin_m.push_back(state_->known_m());
  state_->place.Learn(segment);
  state_->segments.push_back(std::move(segment));
  return {};
}

void ReplaySession::MarkComplete() { state_->complete = true; }

void ReplaySession::GoOnFrom(const LeftAt& left) {
  state_->place_finder.emplace(left);
  ConfidenceOptions confidence = state_->confidence.options();
  confidence.not_found = "the place where it was left is not found";
  state_->confidence = Confidence(confidence);
}

double ReplaySession::known_m() const { return state_->known_m(); }

Result<ReplayStep> ReplaySession::Observe(const Observation& observation) {
  State& s = *state_;
  if (auto checked = s.check.Check(observation); !checked) {
    if (checked.error().code != ErrorCode::kInvalidArgument) {
      return tl::unexpected(checked.error());
    }
    return s.StepWithoutPicture(checked.error().message);
  }
  s.frames_without_picture = 0;
  const image::GrayImage& frame = s.unroller.Unroll(observation.image);
  const auto driven = s.OdometryStep(observation);
  const auto odometry = UsesOdometry(s.options.method) ? driven : std::nullopt;
  const double dt_s = s.last_stamp ? Seconds(observation.stamp - *s.last_stamp) : 0.0;
  s.last_stamp = observation.stamp;
  const std::vector<route::TrackedFeature> before = s.tracker.Current();
  const std::vector<route::TrackedFeature> tracked = s.tracker.Track(frame);
  s.searches.clear();
  if (s.state == ReplayState::kArrived) return s.last_report;
  if (s.segments.empty()) return s.Report({});
  if (!s.begun) s.BeginPlace(frame);
  s.place.Move({odometry, Flow(before, tracked, frame.width), dt_s});
  s.last_report = s.ByViews() ? s.StepByViews(frame) : s.StepByFeatures(frame, tracked, odometry);
  const belief::RouteBelief::Place& where = s.place.where();
  const double length = std::max(1e-9, s.place.belief().length());
  s.last_report.believed = {where.along / length, where.sigma / length, where.off_route};
  return s.last_report;
}

std::vector<replay::FeatureView> ReplaySession::ViewFeatures(const ReplayStep& step) const {
  if (!state_->follower) return {};
  return replay::ViewFeatures(*state_->follower, state_->tracker.Current(), step.decision.roll_rad);
}

}  // namespace trailcast::agent
