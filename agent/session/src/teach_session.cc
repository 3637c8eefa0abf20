#include "agent/session/teach_session.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "agent/session/src/kept_drive.h"
#include "agent/session/src/mount_watch.h"
#include "agent/session/src/told_motion.h"
#include "services/teach/ground_feel.h"
#include "services/teach/picture_shake.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {
namespace {

// With fewer features than this in view a segment says nothing of where the path leads.
constexpr std::size_t kMinFeatures = 8;

Observation Reduced(const Observation& seen, vision::PictureIntake& intake) {
  return {seen.stamp, intake.Reduce(seen.image), seen.odometry, seen.unknown, seen.imu};
}

int LongerSide(const image::GrayImage& picture, const vision::IntakeOptions& intake) {
  const auto size = vision::WorkingSize({picture.width, picture.height}, intake);
  return std::max(size.width, size.height);
}

}  // namespace

struct TeachSession::State {
  State(const TeachOptions& options, const image::GrayImage& frame, bool odometry)
      : tracker(options.features),
        recorder(frame.width, options.recorder),
        shake(frame.height),
        key_views(frame.width, odometry ? options.key_views_with_odometry : options.key_views),
        middle_features(options.middle_features) {}

  vision::FeatureTracker tracker;
  vision::ViewDescriber describer;
  teach::SegmentRecorder recorder;
  teach::PictureShake shake;
  teach::GroundFeel feel;
  std::optional<SensorTime> last_stamp;
  std::vector<teach::MovedFeature> moved;  // since the last frame
  teach::KeyViewRecorder key_views;
  int middle_features;
  route::View last_view;
  bool last_is_kept = false;
  // A segment is under way with features, or blind, by odometry alone, until some come into view.
  enum class Recording { kNothing, kBlind, kFeatures, kTurn } recording = Recording::kNothing;

  using Event = teach::SegmentRecorder::Event;
  [[nodiscard]] Event Add(const image::GrayImage& frame, const Observation& observation);
  void FeelGround(const Observation& observation,
                  const std::vector<route::TrackedFeature>& tracked);
  [[nodiscard]] std::optional<route::Segment> EndSegment();
  void BeginSegment(const Observation& observation);
  void KeepView(const image::GrayImage& frame);
};

TeachSession::State::Event TeachSession::State::Add(const image::GrayImage& frame,
                                                    const Observation& observation) {
  const std::vector<route::TrackedFeature> before = tracker.Current();
  const std::vector<route::TrackedFeature> tracked = tracker.Track(frame);
  moved = teach::MovedBetween(before, tracked);
  if (recording == Recording::kNothing) return Event::kEnds;
  const bool by_features = recording == Recording::kFeatures;
  const Event event =
      recorder.Add(observation.stamp, by_features ? tracked : std::vector<route::TrackedFeature>{},
                   observation.odometry);
  FeelGround(observation, tracked);
  if (event != Event::kGoesOn || recording != Recording::kBlind || recorder.behind()) return event;
  return tracker.Detect().size() >= kMinFeatures ? Event::kEnds : Event::kGoesOn;
}

void TeachSession::State::FeelGround(const Observation& observation,
                                     const std::vector<route::TrackedFeature>& tracked) {
  const double dt_s = last_stamp ? Seconds(observation.stamp - *last_stamp) : 0.0;
  last_stamp = observation.stamp;
  shake.Add(observation.stamp, tracked, recorder.advanced());
  feel.Add(observation.imu, dt_s, recorder.advanced());
}

std::optional<route::Segment> TeachSession::State::EndSegment() {
  auto segment = recorder.Finish();
  if (!segment) return segment;
  segment->terrain = {shake.Measure(), feel.vertical_mps2(), feel.slope_rad()};
  auto& uphill_rad = segment->terrain.slope_rad;
  if (uphill_rad && segment->reverse) uphill_rad = -*uphill_rad;  // the nose points downhill
  shake.EndSegment();
  feel.EndSegment();
  return segment;
}

void TeachSession::State::BeginSegment(const Observation& observation) {
  tracker.Detect(observation.odometry ? middle_features : 0);
  std::vector<route::DescribedFeature> features = tracker.Describe();
  if (features.size() < kMinFeatures) {
    features.clear();
    tracker.Follow({});
  }
  shake.Begin(tracker.Current());
  recording = !features.empty()      ? Recording::kFeatures
              : observation.odometry ? Recording::kBlind
                                     : Recording::kNothing;
  if (recording != Recording::kNothing) {
    recorder.Begin(observation.stamp, std::move(features), observation.odometry);
  }
}

void TeachSession::State::KeepView(const image::GrayImage& frame) {
  last_view = describer.Describe(frame);
  last_is_kept = recording != Recording::kNothing && key_views.Add(last_view);
  if (last_is_kept) recorder.Keep(key_views.kept());
}

// This is needed until a turn has told how the camera is mounted.
struct TeachSession::Mount {
  explicit Mount(std::size_t most_kept_bytes) : kept(most_kept_bytes) {}

  MountWatch watch;
  KeptDrive kept;
  ToldMotion base;
  std::optional<SensorTime> last_stamp;
  std::optional<motion::Pose2> last_odometry;
};

// These frames have to be taught before those that come next.
struct TeachSession::Waiting {
  std::deque<KeptDrive::Frame> frames;
};

TeachSession::TeachSession(const TeachOptions& options)
    : options_(options),
      intake_(options.intake),
      mount_(std::make_unique<Mount>(options.most_kept_bytes)),
      waiting_(std::make_unique<Waiting>()) {}
TeachSession::~TeachSession() = default;
TeachSession::TeachSession(TeachSession&&) noexcept = default;

Result<TeachStep> TeachSession::Observe(const Observation& observation) {
  if (auto checked = check_.Check(observation); !checked) return tl::unexpected(checked.error());
  const int number = observed_++;
  if (!waiting_->frames.empty()) {
    waiting_->frames.push_back({number, Reduced(observation, intake_)});
    return *CatchUp();
  }
  frame_ = number;
  TeachStep step = Take(observation);
  if (!mount_) return step;
  auto anew = LookAtMount(observation);
  if (!anew) return tl::unexpected(anew.error());
  if (!*anew) return step;
  step = {};
  step.anew = *std::move(*anew);
  return step;
}

bool TeachSession::catching_up() const { return !waiting_->frames.empty(); }

std::optional<TeachStep> TeachSession::CatchUp() {
  if (waiting_->frames.empty()) return std::nullopt;
  const KeptDrive::Frame next = std::move(waiting_->frames.front());
  waiting_->frames.pop_front();
  frame_ = next.number;
  return Take(next.seen);
}

// Examines the frame that was taken last. Returns nothing if the camera is mounted as stated, as
// far as is known.
Result<std::optional<TaughtAnew>> TeachSession::LookAtMount(const Observation& observation) {
  Mount& mount = *mount_;
  std::optional<motion::OdometryIncrement> measured;
  std::optional<motion::OdometryIncrement> told;
  double dt_s = 0.0;
  if (mount.last_stamp) dt_s = Seconds(observation.stamp - *mount.last_stamp);
  if (mount.last_odometry && observation.odometry) {
    measured = motion::IncrementBetween(*mount.last_odometry, *observation.odometry);
  }
  if (observation.told) told = mount.base.Drive(*observation.told, dt_s);
  mount.last_stamp = observation.stamp;
  mount.last_odometry = observation.odometry;
  const auto& picture = observation.image;
  mount.watch.Add(state_->moved, told, measured, dt_s, LongerSide(picture, options_.intake));
  if (observation.odometry || observation.told) {
    mount.kept.Add(frame_, Reduced(observation, intake_));
  }
  const auto roll_deg = mount.watch.roll_deg();
  if (!roll_deg) return std::nullopt;
  const auto watched = std::move(mount_);
  if (*roll_deg == 0.0) return std::nullopt;
  TaughtAnew anew{options_.intake, watched->watch.Text()};
  anew.intake.roll_deg = RollAfter(options_.intake.roll_deg, *roll_deg);
  if (!watched->kept.whole()) {
    return Fail(ErrorCode::kInvalidArgument,
                "{}. It is too late to turn what was taught before this first turn: teach it again "
                "with --camera-roll {:g}",
                anew.text, anew.intake.roll_deg);
  }
  options_.intake = anew.intake;
  intake_ = vision::PictureIntake(anew.intake);
  state_.reset();
  waiting_->frames = watched->kept.Take();
  return anew;
}

TeachStep TeachSession::Take(const Observation& observation) {
  const image::GrayImage& frame = intake_.Take(observation.image);
  if (!state_) state_ = std::make_unique<State>(options_, frame, observation.odometry.has_value());
  State& s = *state_;
  TeachStep step;
  const State::Event event = s.Add(frame, observation);
  if (event != State::Event::kGoesOn && s.recording != State::Recording::kTurn) {
    step.finished = s.EndSegment();
  }
  if (event == State::Event::kEnds) s.BeginSegment(observation);
  if (event == State::Event::kTurns) s.recording = State::Recording::kTurn;
  s.KeepView(frame);
  step.features = s.tracker.count();
  if (observation.odometry && s.recording != State::Recording::kTurn) {
    step.ahead_m = std::max(0.0, s.recorder.distance_m());
  }
  step.weakness = s.key_views.weakness();
  step.too_few_features = s.recording != State::Recording::kFeatures;
  step.reverse = s.recorder.reverse();
  return step;
}

double TeachSession::turned_rad() const { return state_ ? state_->recorder.turned_rad() : 0.0; }

std::optional<route::Segment> TeachSession::Finish() {
  if (!state_ || state_->recording == State::Recording::kNothing) return std::nullopt;
  State& s = *state_;
  if (!s.last_is_kept && s.key_views.Keep(s.last_view)) s.recorder.Keep(s.key_views.kept());
  s.recording = State::Recording::kNothing;
  return s.EndSegment();
}

}  // namespace trailcast::agent
