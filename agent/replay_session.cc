#include "agent/replay_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "agent/confidence.h"
#include "agent/frame_check.h"
#include "agent/hand_over.h"
#include "services/vision/donut.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {
namespace {

constexpr double kUncertainSpeedFactor = 0.6;
// Blind robots look for the route again every so many frames: the wide search costs time.
constexpr int kLookAgain_frames = 5;
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

}  // namespace

struct ReplaySession::State {
  ReplayMethodOptions options;
  int scout_width_px = 0;
  std::vector<route::Segment> segments;
  std::vector<double> begin_m;  // of each segment, along the route
  bool complete = false;

  FrameCheck check;
  vision::DonutUnroller unroller;
  vision::FeatureTracker tracker;
  std::optional<HandOver> hand_over;
  std::optional<PlaceFinder> place_finder;     // until it has found the place
  std::unique_ptr<replay::Follower> follower;  // made when the first segment begins
  std::optional<motion::Pose2> last_odometry;
  ReplayState state = ReplayState::kWaiting;
  std::string reason;
  int frames_since_find = 0;
  Confidence confidence;
  Trust trust = Trust::kSeeking;
  std::vector<Search> searches;  // in this frame

  [[nodiscard]] std::optional<motion::OdometryIncrement> OdometryStep(
      const Observation& observation);
  void MakeFollower(const image::GrayImage& frame, const route::Segment& first);
  void Begin(std::size_t index, const image::GrayImage& frame);
  [[nodiscard]] bool BeginNext(const image::GrayImage& frame);
  [[nodiscard]] bool BeginWhereLeft(const image::GrayImage& frame);
  void EndSegment(const image::GrayImage& frame);
  void Follow(const std::vector<route::TrackedFeature>& found);
  void LookAgain(const image::GrayImage& frame);
  void Refresh(const image::GrayImage& frame, const replay::FollowStep& step);
  void JudgeSight(const replay::FollowStep& step,
                  const std::optional<motion::OdometryIncrement>& odometry,
                  const image::GrayImage& frame);
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

void ReplaySession::State::MakeFollower(const image::GrayImage& frame,
                                        const route::Segment& first) {
  follower = agent::MakeFollower(options, last_odometry.has_value() && first.has_odometry,
                                 scout_width_px, static_cast<double>(frame.width) / scout_width_px);
  const std::size_t known = std::min(segments.size(), kMostLearnt);
  for (std::size_t i = 0; i < known; ++i) follower->Learn(segments[i]);
}

// Hand-over: the segment's stored features are found in this frame and followed from here.
void ReplaySession::State::Begin(std::size_t index, const image::GrayImage& frame) {
  const route::Segment& segment = segments[index];
  if (!follower) MakeFollower(frame, segment);
  follower->Begin(segment);
  Follow(hand_over->ToSegment(frame, *follower));
  searches.push_back(
      SearchOf(SearchKind::kHandOver, segment, tracker.count(), hand_over->last_was_wide()));
  frames_since_find = 0;
}

// False: it has not found the place, yet or at all.
bool ReplaySession::State::BeginWhereLeft(const image::GrayImage& frame) {
  if (const auto found = place_finder->Look(frame, segments, *hand_over)) {
    const route::Segment& segment = segments[found->segment.value()];
    MakeFollower(frame, segment);
    follower->BeginAt(segment, found->fraction);
    hand_over->TakeUp(found->seen, *follower);
    Follow(found->seen.features);
    searches.push_back(SearchOf(SearchKind::kRecovered, segment, tracker.count(), false));
    place_finder.reset();
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

// Of a robot that stands, for want of a segment to follow. False: there is none yet.
bool ReplaySession::State::BeginNext(const image::GrayImage& frame) {
  if (place_finder) return BeginWhereLeft(frame);
  const std::size_t next = follower ? follower->segment().index.value() + 1 : 0;
  if (next < segments.size()) {
    Begin(next, frame);
    return true;
  }
  if (complete && follower) state = ReplayState::kArrived;
  return false;
}

void ReplaySession::State::EndSegment(const image::GrayImage& frame) {
  const std::size_t next = follower->segment().index.value() + 1;
  if (next < segments.size()) {
    Begin(next, frame);
  } else if (complete) {
    state = ReplayState::kArrived;
    reason = "arrived at the end of the route";
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

void ReplaySession::State::LookAgain(const image::GrayImage& frame) {
  if (confidence.unsure_frames() % kLookAgain_frames != 0) return;
  const auto ahead = WhereItMayBe(segments, follower->segment().index, last_odometry.has_value(),
                                  confidence.unsure_frames());
  const auto seen = hand_over->Recover(frame, *follower, ahead, last_odometry.has_value());
  if (!seen) return;
  if (seen->segment != 0) follower->Begin(ahead[seen->segment]);
  Follow(seen->features);
  searches.push_back(SearchOf(SearchKind::kRecovered, follower->segment(), tracker.count(), true));
}

// Features once lost (blur, a passer-by) come back into view, and to a robot that was carried off
// they are elsewhere: look for them again.
void ReplaySession::State::Refresh(const image::GrayImage& frame, const replay::FollowStep& step) {
  const route::Segment& segment = follower->segment();
  const bool few = step.agreeing < kEnoughShare * static_cast<double>(segment.features.size());
  const bool due = ++frames_since_find >= kRefresh_frames && few;
  if (AsPrinted(options.method) || (!due && !step.carried_left_m)) return;
  frames_since_find = 0;
  std::vector<route::TrackedFeature> found = hand_over->Again(frame, *follower);
  if (static_cast<int>(found.size()) <= step.agreeing) return;
  tracker.Follow(found);
  searches.push_back(SearchOf(SearchKind::kLookedAgain, segment, tracker.count(), false));
}

void ReplaySession::State::JudgeSight(const replay::FollowStep& step,
                                      const std::optional<motion::OdometryIncrement>& odometry,
                                      const image::GrayImage& frame) {
  const route::Segment& segment = follower->segment();
  Sighting seen{segment.index.value(), static_cast<int>(segment.features.size()), step.agreeing,
                tracker.losses().not_returned};
  seen.carried_off = step.carried_left_m.has_value();
  if (step.offset) {
    seen.left_sigma_m = step.offset->left_sigma_m;
    seen.in_picture = static_cast<int>(InPicture(follower->Expect(), frame));
  }
  Verdict verdict = confidence.Judge(seen, odometry);
  trust = verdict.trust;
  state = StateOf(trust);
  reason = std::move(verdict.reason);
  if (trust == Trust::kBlind || trust == Trust::kSeeking) LookAgain(frame);
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

ReplayStep ReplaySession::State::Report(const replay::FollowStep& step) const {
  ReplayStep report;
  report.state = state;
  report.trust = trust;
  report.sight = {0, tracker.losses(), searches};
  report.reason = reason;
  if (hand_over) {
    report.found_share = hand_over->found_share();
    report.hand_overs = hand_over->count();
  }
  report.features = tracker.count();
  if (!follower) return report;
  report.segment = follower->segment().index;
  report.sight.stored = static_cast<int>(follower->segment().features.size());
  report.magnification = follower->magnification();
  report.fraction = state == ReplayState::kArrived ? 1.0 : step.fraction;
  report.progress =
      (report.segment.value() + report.fraction) / static_cast<double>(segments.size());
  if (confidence.ever_sure() && follower->segment().has_odometry) {
    report.along_m =
        begin_m[report.segment.value()] + report.fraction * follower->segment().length_m;
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
    : state_(std::make_unique<State>()) {
  state_->options = options;
  ConfidenceOptions confidence;
  confidence.stand_when_covered = !AsPrinted(options.method);
  state_->confidence = Confidence(confidence);
  state_->scout_width_px = route.image_width_px;
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
  const auto& known = state_->segments;
  state_->begin_m.push_back(known.empty() ? 0.0 : state_->begin_m.back() + known.back().length_m);
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

double ReplaySession::known_m() const {
  const State& s = *state_;
  return s.segments.empty() ? 0.0 : s.begin_m.back() + s.segments.back().length_m;
}

Result<ReplayStep> ReplaySession::Observe(const Observation& observation) {
  State& s = *state_;
  if (auto checked = s.check.Check(observation); !checked) return tl::unexpected(checked.error());
  const image::GrayImage& frame = s.unroller.Unroll(observation.image);
  const auto driven = s.OdometryStep(observation);
  const auto odometry = UsesOdometry(s.options.method) ? driven : std::nullopt;
  const std::vector<route::TrackedFeature> tracked = s.tracker.Track(frame);
  s.searches.clear();
  if (s.state == ReplayState::kArrived) return s.Report({});
  if (!s.follower || s.state == ReplayState::kWaiting) {
    if (!s.hand_over) s.hand_over.emplace(!AsPrinted(s.options.method), s.scout_width_px);
    if (!s.BeginNext(frame)) return s.Report({});
    const replay::FollowStep first = s.follower->Step({s.tracker.Current(), odometry});
    s.JudgeSight(first, odometry, frame);
    return s.Report(first);
  }
  const SegmentIndex before = s.follower->segment().index;
  replay::FollowStep step = s.follower->Step({tracked, odometry});
  s.JudgeSight(step, odometry, frame);
  s.Refresh(frame, step);
  const bool next_is_here = s.follower->segment().index.value() + 1 < s.segments.size();
  // What covers this segment's features covers the next one's too.
  const bool covered = s.trust == Trust::kCovered || s.confidence.view_is_going();
  const bool wants_next = step.wants_next && next_is_here && !covered;
  if (s.state != ReplayState::kLost && (step.ended || wants_next)) s.EndSegment(frame);
  // A segment that has just begun is not as far along as the last one was.
  if (s.follower->segment().index != before) step.fraction = 0.0;
  return s.Report(step);
}

std::vector<replay::FeatureView> ReplaySession::ViewFeatures(const ReplayStep& step) const {
  if (!state_->follower) return {};
  return replay::ViewFeatures(*state_->follower, state_->tracker.Current(), step.decision.roll_rad);
}

}  // namespace trailcast::agent
