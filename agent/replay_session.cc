#include "agent/replay_session.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "agent/frame_check.h"
#include "agent/hand_over.h"
#include "services/replay/funnel_follower.h"
#include "services/replay/path_follower.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {
namespace {

// With fewer features than this there is nothing to steer by.
constexpr std::size_t kMinFeatures = 4;
// So many of a segment's features have to agree with what was taught for the robot to be sure that
// it is on the path. A handful can be found in any picture: a robot that follows those alone would
// drive through the wrong building with confidence.
constexpr double kSureShare = 0.4;
constexpr double kSureFeatures_least = 5.0;
constexpr double kSureFeatures_most = 8.0;
// How far a robot that is not sure may go on, and how long one without odometry, or one that has
// not found the route yet, may look around, before it is lost.
constexpr double kBlindLimit_m = 2.5;
constexpr int kBlindLimit_frames = 90;
constexpr double kBlindSpeedFactor = 0.6;
// Blind robots look for the route again every so many frames: the wide search costs time.
constexpr int kLookAgain_frames = 5;
// With a smaller share of the segment's features than this they are sought again, every so often.
constexpr double kEnoughShare = 0.5;
constexpr int kRefresh_frames = 6;

// The route's end is approached ever more slowly, so that the robot stands where it is reached.
constexpr double kEndDeceleration_mps2 = 0.25;
constexpr double kEndSpeed_mps = 0.08;

constexpr double kBangBang_radps = 0.35;

// The methods as printed; what this project adds is left out.
bool AsPrinted(ReplayMethod method) { return method != ReplayMethod::kDefault; }

std::unique_ptr<replay::Follower> MakeFollower(const ReplaySessionOptions& options,
                                               bool by_odometry, int scout_width_px,
                                               double magnification) {
  if (options.method == ReplayMethod::kDefault && by_odometry) {
    replay::PathFollowerOptions path;
    path.limits = options.limits;
    path.speed_factor = options.speed_factor;
    return std::make_unique<replay::PathFollower>(scout_width_px, magnification, path);
  }
  replay::FunnelFollowerOptions funnel;
  if (options.method == ReplayMethod::kIcra2006) {
    funnel.bang_bang_radps = kBangBang_radps;
    funnel.compensate_roll = false;
  }
  funnel.limits = options.limits;
  funnel.speed_factor = options.speed_factor;
  return std::make_unique<replay::FunnelFollower>(scout_width_px, magnification, funnel);
}

}  // namespace

const char* ToString(ReplayState state) {
  switch (state) {
    case ReplayState::kWaiting:
      return "WAITING";
    case ReplayState::kFollowing:
      return "FOLLOWING";
    case ReplayState::kBlind:
      return "BLIND";
    case ReplayState::kArrived:
      return "ARRIVED";
    case ReplayState::kLost:
      return "LOST";
  }
  return "UNKNOWN";
}

const std::vector<std::string>& ReplayMethodNames() {
  static const std::vector<std::string> names = {"default", "paper", "icra2006"};
  return names;
}

Result<ReplayMethod> FindReplayMethod(const std::string& name) {
  if (name == "default") return ReplayMethod::kDefault;
  if (name == "paper") return ReplayMethod::kPaper;
  if (name == "icra2006") return ReplayMethod::kIcra2006;
  return Fail(ErrorCode::kNotFound, "there is no method '{}'; there are: {}", name,
              fmt::join(ReplayMethodNames(), ", "));
}

struct ReplaySession::State {
  ReplaySessionOptions options;
  int scout_width_px = 0;
  std::vector<route::Segment> segments;
  bool complete = false;

  FrameCheck check;
  vision::FeatureTracker tracker;
  std::optional<HandOver> hand_over;
  std::unique_ptr<replay::Follower> follower;  // made when the first segment begins
  std::optional<motion::Pose2> last_odometry;
  ReplayState state = ReplayState::kWaiting;
  std::string reason;
  int frames_since_find = 0;
  bool sure_once = false;  // has been sure of the path before
  // Since it was last sure.
  double unsure_m = 0.0;
  int unsure_frames = 0;

  [[nodiscard]] std::optional<motion::OdometryIncrement> OdometryStep(
      const Observation& observation);
  void Begin(std::size_t index, const image::GrayImage& frame);
  void EndSegment(const image::GrayImage& frame);
  void LookAgain(const image::GrayImage& frame);
  void Refresh(const image::GrayImage& frame);
  void JudgeSight(std::size_t agreeing, const std::optional<motion::OdometryIncrement>& odometry,
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

// Hand-over: the segment's stored features are found in this frame and followed from here.
void ReplaySession::State::Begin(std::size_t index, const image::GrayImage& frame) {
  const route::Segment& segment = segments[index];
  if (!follower) {
    follower = MakeFollower(options, last_odometry.has_value() && segment.has_odometry,
                            scout_width_px, static_cast<double>(frame.width) / scout_width_px);
  }
  follower->Begin(segment);
  tracker.Follow(hand_over->ToSegment(frame, *follower));
  frames_since_find = 0;
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

void ReplaySession::State::LookAgain(const image::GrayImage& frame) {
  if (unsure_frames % kLookAgain_frames != 0) return;
  const std::size_t here = follower->segment().index.value();
  const std::span<const route::Segment> ahead(segments.data() + here,
                                              std::min<std::size_t>(3, segments.size() - here));
  const auto seen = hand_over->Recover(frame, follower->magnification(), ahead);
  if (!seen) return;
  if (seen->segment != 0) {
    follower->Begin(ahead[seen->segment]);
  }
  tracker.Follow(seen->features);
}

// Features once lost (blur, a passer-by) come back into view: look for them again.
void ReplaySession::State::Refresh(const image::GrayImage& frame) {
  const route::Segment& segment = follower->segment();
  if (AsPrinted(options.method) || ++frames_since_find < kRefresh_frames ||
      tracker.count() >= kEnoughShare * static_cast<double>(segment.features.size())) {
    return;
  }
  frames_since_find = 0;
  std::vector<route::TrackedFeature> found = hand_over->Again(frame, *follower);
  if (static_cast<int>(found.size()) > tracker.count()) tracker.Follow(found);
}

// Sure of the path, or not: then on for a while, by the few features there are or by odometry
// alone, slowly, looking for the route; then lost.
void ReplaySession::State::JudgeSight(std::size_t agreeing,
                                      const std::optional<motion::OdometryIncrement>& odometry,
                                      const image::GrayImage& frame) {
  const std::size_t taught = follower->segment().features.size();
  if (taught < kMinFeatures) {  // nothing was to be seen here when it was taught
    state = ReplayState::kFollowing;
    reason = "this stretch was taught without features: on by odometry";
    return;
  }
  const double wanted =
      std::clamp(kSureShare * static_cast<double>(taught), kSureFeatures_least, kSureFeatures_most);
  if (static_cast<double>(agreeing) >= std::min(wanted, static_cast<double>(taught))) {
    state = ReplayState::kFollowing;
    reason.clear();
    sure_once = true;
    unsure_m = 0.0;
    unsure_frames = 0;
    return;
  }
  unsure_m += odometry ? std::abs(odometry->distance_m) : 0.0;
  ++unsure_frames;
  const bool by_distance = odometry && sure_once;
  const bool lost = by_distance ? unsure_m > kBlindLimit_m : unsure_frames > kBlindLimit_frames;
  const bool steers = sure_once && agreeing >= kMinFeatures;
  state = lost ? ReplayState::kLost : steers ? ReplayState::kFollowing : ReplayState::kBlind;
  reason = fmt::format(
      "{}{} of segment {}'s {} features in view for {}; {:.0f} are needed to be sure",
      sure_once ? "" : "the route's start is not found: ", agreeing,
      follower->segment().index.value(), taught,
      by_distance ? fmt::format("{:.1f} m", unsure_m) : fmt::format("{} frames", unsure_frames),
      wanted);
  if (agreeing < kMinFeatures) LookAgain(frame);
}

// Share of the method's speed that is driven: less when blind and before the route's end.
double ReplaySession::State::SpeedShare(const replay::FollowStep& step) const {
  const double share = state == ReplayState::kBlind ? kBlindSpeedFactor : 1.0;
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
  report.reason = reason;
  if (hand_over) {
    report.found_share = hand_over->found_share();
    report.hand_overs = hand_over->count();
  }
  report.features = tracker.count();
  if (!follower) return report;
  report.segment = follower->segment().index;
  report.fraction = state == ReplayState::kArrived ? 1.0 : step.fraction;
  report.progress =
      (report.segment.value() + report.fraction) / static_cast<double>(segments.size());
  report.turn_rad = step.turn_rad;
  report.decision = step;
  const bool drive = state == ReplayState::kFollowing ||
                     (state == ReplayState::kBlind && sure_once && last_odometry.has_value());
  if (drive) {
    const double share = SpeedShare(step);
    report.command = {share * step.command.linear_mps, share * step.command.angular_radps};
  }
  return report;
}

ReplaySession::ReplaySession(const ReplaySessionOptions& options, const route::RouteInfo& route)
    : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->scout_width_px = route.image_width_px;
}

ReplaySession::~ReplaySession() = default;
ReplaySession::ReplaySession(ReplaySession&&) noexcept = default;

Result<void> ReplaySession::AddSegment(route::Segment segment) {
  if (segment.index.value() != state_->segments.size()) {
    return Fail(ErrorCode::kInvalidArgument, "segment {} was given where {} comes next",
                segment.index.value(), state_->segments.size());
  }
  state_->segments.push_back(std::move(segment));
  return {};
}

void ReplaySession::MarkComplete() { state_->complete = true; }

Result<ReplayStep> ReplaySession::Observe(const Observation& observation) {
  State& s = *state_;
  if (auto checked = s.check.Check(observation); !checked) return tl::unexpected(checked.error());
  const image::GrayImage& frame = observation.image;
  const auto driven = s.OdometryStep(observation);
  const auto odometry = s.options.method == ReplayMethod::kIcra2006 ? std::nullopt : driven;
  const std::vector<route::TrackedFeature> tracked = s.tracker.Track(frame);
  if (s.state == ReplayState::kArrived) return s.Report({});
  if (s.state == ReplayState::kWaiting) {
    const std::size_t next = s.follower ? s.follower->segment().index.value() + 1 : 0;
    if (next >= s.segments.size()) {
      if (s.complete && s.follower) s.state = ReplayState::kArrived;
      return s.Report({});
    }
    if (!s.hand_over) {
      s.hand_over.emplace(!AsPrinted(s.options.method), s.scout_width_px);
    }
    s.Begin(next, frame);
    const replay::FollowStep first = s.follower->Step({s.tracker.Current(), odometry});
    s.JudgeSight(static_cast<std::size_t>(first.agreeing), odometry, frame);
    return s.Report(first);
  }
  const replay::FollowStep step = s.follower->Step({tracked, odometry});
  s.JudgeSight(static_cast<std::size_t>(step.agreeing), odometry, frame);
  s.Refresh(frame);
  const bool next_is_here = s.follower->segment().index.value() + 1 < s.segments.size();
  if (s.state != ReplayState::kLost && (step.ended || (step.wants_next && next_is_here))) {
    s.EndSegment(frame);
  }
  return s.Report(step);
}

}  // namespace trailcast::agent
