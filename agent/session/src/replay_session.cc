#include "agent/session/replay_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "agent/session/src/frame_pace.h"
#include "agent/session/src/front_end.h"
#include "agent/session/src/mount_watch.h"
#include "agent/session/src/place/known_route.h"
#include "agent/session/src/place/localiser.h"
#include "agent/session/src/place/view_taker.h"
#include "agent/session/src/route_follower.h"
#include "agent/session/src/upright_watch.h"
#include "services/route/as_driven.h"

namespace trailcast::agent {
namespace {

constexpr double kMostWithoutPicture_s = 3.0;
constexpr double kFirstFrame_s = 1.0 / 30.0;
// A robot that is put at the route's start may be this far from it, in the route's units.
constexpr double kStart_sigma = 0.25;
constexpr double kLeft_m = 0.5;    // distance from where it was left
constexpr double kDoubted = 0.85;  // odometry that is doubted more says next to nothing
constexpr double kTurns_rad_per_m = 1.0;

vision::IntakeOptions IntakeOf(const ReplayMethodOptions& options) {
  vision::IntakeOptions intake = options.intake;
  if (options.lens) intake.roll_deg = options.lens->roll_deg.value_or(intake.roll_deg);
  return intake;
}

// Where the pictures contradict odometry, the robot may have come as far as the scout did in that
// time, with the turns that this takes, beside what odometry tells.
FrameInput Doubted(FrameInput seen, const Localiser& place) {
  const double doubt = seen.frozen ? 1.0 : 1.0 - place.TrustInOdometry().value_or(1.0);
  if (doubt < kDoubted || !seen.driven) return seen;
  const double come_m = std::max(std::abs(seen.driven->distance_m), place.PaceAt_m(seen.dt_s));
  seen.unknown.distance_m = std::hypot(seen.unknown.distance_m, doubt * come_m);
  seen.unknown.heading_change_rad =
      std::hypot(seen.unknown.heading_change_rad,
                 doubt * (kTurns_rad_per_m * come_m + std::abs(seen.driven->heading_change_rad)));
  return seen;
}

}  // namespace

// This is a picture's path: the front end, the place, and the follower that steers.
struct ReplaySession::State {
  State(const ReplayMethodOptions& method, const route::RouteInfo& info)
      : options(method),
        route(info.segment_count),
        front_end(IntakeOf(method), !AsPrinted(method.method)),
        place(info.image_width_px),
        scout{info.image_width_px, info.image_height_px} {
    follower.emplace(method, scout, route, front_end, place, ViewFollower(method, route, place));
    if (method.take_experience) views_met.emplace(info.image_width_px, info.image_height_px);
  }

  [[nodiscard]] ReplayStep StepWithoutPicture(const std::string& why);
  void NoteTime(SensorTime stamp);
  void StartPlace(int width_px);
  bool Locate(const FrameInput& seen);  // true if it examined what is recognised
  [[nodiscard]] ReplayStep Turned(double turn_deg, const Observation& observation);
  [[nodiscard]] ReplayStep StandMisturned();

  ReplayMethodOptions options;
  KnownRoute route;
  FrontEnd front_end;
  UprightWatch upright;
  FramePace pace;
  Localiser place;
  vision::PictureSize scout;
  std::optional<RouteFollower> follower;  // always set
  std::optional<ViewTaker> views_met;
  std::optional<LeftAt> left;
  bool begun = false;  // a frame was seen while some of the route was known
  std::optional<SensorTime> last_stamp;
  double looked_s = 0.0;  // since the last frame, seen or not, but no longer than kLongestFrame_s
  double without_picture_s = 0.0;
  const image::GrayImage* picture = nullptr;
  bool passed = false;     // it was not examined
  std::string turned;      // see ReplayStep
  bool misturned = false;  // its pictures mislead it in whatever it does
  ReplayStep last;         // with its status, which is the run's
};

// Handles a camera that gives no usable picture: the robot stands for a while.
ReplayStep ReplaySession::State::StepWithoutPicture(const std::string& why) {
  if (last.state == ReplayState::kArrived || last.state == ReplayState::kLost) return last;
  ReplayStep report = last;
  without_picture_s += looked_s;
  const bool lost = without_picture_s > kMostWithoutPicture_s + kTimeSlack_s;
  report.command = {};
  report.state = lost ? ReplayState::kLost : ReplayState::kBlind;
  report.trust = lost ? Trust::kLost : Trust::kBlind;
  report.evidence = Evidence::kNothing;
  report.reason = why;
  report.saw_nothing = true;
  last.trust = report.trust;
  if (lost) last = report;
  return report;
}

void ReplaySession::State::NoteTime(SensorTime stamp) {
  const auto before = std::exchange(last_stamp, stamp);
  if (before) pace.Note(Seconds(stamp - *before));
  looked_s = before ? std::clamp(Seconds(stamp - *before), 0.0, kLongestFrame_s) : kFirstFrame_s;
}

void ReplaySession::State::StartPlace(int width_px) {
  begun = true;
  if (left) {
    if (left->magnification) place.KnowMagnification(*left->magnification, width_px);
    place.StartAt(left->along_m, kLeft_m);
  } else if (options.anywhere) {
    place.StartAnywhere();
  } else {
    place.StartAt(0.0, kStart_sigma);
  }
}

bool ReplaySession::State::Locate(const FrameInput& seen) {
  if (!begun) StartPlace(seen.frame->width);
  FrameMotion along{seen.measured,           seen.told,  seen.flow, seen.dt_s,
                    seen.unknown.distance_m, seen.frozen};
  if (follower->reverses()) {
    if (along.odometry) along.odometry->distance_m = -along.odometry->distance_m;
    if (along.told) along.told->distance_m = -along.told->distance_m;
  }
  place.Move(along);
  const bool looks = follower->WantsLook(last.trust);
  if (looks) place.LookAt(*seen.followed_in, seen.frame->width);
  return looks;
}

// The earlier frames were misread. The robot stands in this frame, and begins with the next.
ReplayStep ReplaySession::State::Turned(double turn_deg, const Observation& observation) {
  vision::IntakeOptions intake = front_end.intake();
  intake.roll_deg = RollAfter(intake.roll_deg, turn_deg);
  turned = fmt::format(
      "{}: its pictures are turned by {:g} degrees from here on; --camera-roll {:g} has it so from "
      "the beginning",
      upright.Text(), turn_deg, intake.roll_deg);
  front_end.Turn(intake);
  picture = front_end.Pass(observation);
  follower.emplace(options, scout, route, front_end, place, ViewFollower(follower->views()));
  if (left) follower->GoOnFrom(*left);
  ReplayStep step = follower->ReportOf({Trust::kSeeking, "turns its pictures as its camera hangs"},
                                       ReplayState::kBlind);
  step.saw_nothing = true;
  step.turned = turned;
  return step;
}

// Nothing that it would do on such pictures is right, since left is right, or up.
ReplayStep ReplaySession::State::StandMisturned() {
  misturned = true;
  const double roll_deg =
      RollAfter(front_end.intake().roll_deg, *front_end.mount().roll_by_told_deg());
  ReplayStep step = last;
  step.command = {};
  step.state = ReplayState::kLost;
  step.trust = Trust::kLost;
  step.reason = fmt::format(
      "{}. It stands rather than steer by that: {} with --camera-roll {:g}",
      front_end.mount().Text(),
      upright.upright() ? "teach the route again, whose pictures are so, too," : "begin again",
      roll_deg);
  step.saw_nothing = true;
  return step;
}

ReplaySession::ReplaySession(const ReplayMethodOptions& options, const route::RouteInfo& route)
    : state_(std::make_unique<State>(options, route)) {}

ReplaySession::~ReplaySession() = default;
ReplaySession::ReplaySession(ReplaySession&&) noexcept = default;
ReplaySession& ReplaySession::operator=(ReplaySession&&) noexcept = default;

Result<void> ReplaySession::AddSegment(route::Segment segment) {
  State& s = *state_;
  const std::size_t next = s.route.segments().size();
  if (segment.index.value() != next) {
    return Fail(ErrorCode::kInvalidArgument, "segment {} was given where {} comes next",
                segment.index.value(), next);
  }
  s.follower->Learn(segment);
  s.place.Learn(segment);
  if (s.views_met) s.views_met->Learn(segment);
  s.route.Add(AsPrinted(s.options.method) ? std::move(segment)
                                          : route::AsDriven(std::move(segment)));
  return {};
}

void ReplaySession::MarkComplete() { state_->route.MarkComplete(); }

void ReplaySession::GoOnFrom(const LeftAt& left) {
  state_->left = left;
  state_->follower->GoOnFrom(left);
}

double ReplaySession::known_m() const {
  return state_->place.known() && state_->place.metric() ? state_->route.length_m() : 0.0;
}

Result<ReplayStep> ReplaySession::Observe(const Observation& observation) {
  State& s = *state_;
  s.NoteTime(observation.stamp);
  s.picture = &observation.image;
  s.passed = false;
  auto seen = s.front_end.See(observation);
  if (!seen) {
    if (seen.error().code != ErrorCode::kInvalidArgument) return tl::unexpected(seen.error());
    return s.StepWithoutPicture(seen.error().message);
  }
  s.without_picture_s = 0.0;
  const bool by_views = !s.route.segments().empty() && s.follower->by_views_alone();
  s.front_end.Track(*seen, by_views ? FollowedFor::kFlow : FollowedFor::kPlace);
  s.picture = seen->frame;
  seen->looked_s = s.looked_s;
  if (!UsesOdometry(s.options.method)) seen->driven.reset();
  if (s.last.state == ReplayState::kArrived || s.misturned) return s.last;
  if (s.route.segments().empty()) return s.follower->ReportOf({}, ReplayState::kWaiting);
  const bool looked = s.Locate(*seen);
  if (s.front_end.mount().roll_by_told_deg().value_or(0.0) != 0.0)
    return s.last = s.StandMisturned();
  if (const auto turn_deg = s.upright.Look(*seen, s.place)) {
    return s.last = s.Turned(*turn_deg, observation);
  }
  s.last = s.follower->Step(Doubted(std::move(*seen), s.place), looked);
  s.last.turned = s.turned;
  if (s.views_met && looked && s.last.trust == Trust::kSure) s.views_met->See(s.place);
  if (!AsPrinted(s.options.method)) s.last.command = s.pace.Within(s.last.command);
  const belief::RouteBelief::Place& where = s.place.where();
  const double length = std::max(1e-9, s.place.belief().length());
  s.last.evidence = s.follower->EvidenceOf(s.last);
  if (const auto trust = s.place.TrustInOdometry()) {
    s.last.odometry = {*trust, std::nullopt};
    if (s.place.metric()) s.last.odometry->scale = s.place.ScaleOfWay();
  }
  s.last.believed = {where.along / length, where.sigma / length, where.off_route};
  return s.last;
}

void ReplaySession::Pass(const Observation& observation) {
  state_->picture = state_->front_end.Pass(observation);
  state_->passed = true;
}

std::optional<refresh::Visit> ReplaySession::TakeVisit() {
  if (state_->last.state != ReplayState::kArrived) return std::nullopt;
  if (!state_->views_met) return std::nullopt;
  refresh::Visit visit = state_->follower->TakeVisit().value_or(refresh::Visit{});
  state_->views_met->Take(visit);
  return visit;
}

std::optional<OwnLens> ReplaySession::lens() const {
  auto lens = state_->follower->lens();
  if (lens) lens->roll_deg = state_->front_end.intake().roll_deg;
  return lens;
}

const image::GrayImage* ReplaySession::picture() const { return state_->picture; }

std::vector<replay::FeatureView> ReplaySession::ViewFeatures(const ReplayStep& step) const {
  const replay::Follower* follower = state_->follower->follower();
  if (follower == nullptr || state_->passed) return {};
  return replay::ViewFeatures(*follower, state_->front_end.tracker().Current(),
                              step.decision.roll_rad);
}

}  // namespace trailcast::agent
