#include "agent/session/teach_session.h"

#include <utility>
#include <vector>

#include "services/teach/ground_feel.h"
#include "services/teach/picture_shake.h"
#include "services/vision/view_features.h"

namespace trailcast::agent {
namespace {

// With fewer features than this in view a segment says nothing of where the path leads.
constexpr std::size_t kMinFeatures = 8;

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
  teach::KeyViewRecorder key_views;
  int middle_features;
  route::View last_view;
  bool last_is_kept = false;
  // A segment is under way: with features, or blind, by odometry alone, until some come into view.
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
  const std::vector<route::TrackedFeature> tracked = tracker.Track(frame);
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

TeachSession::TeachSession(const TeachOptions& options)
    : options_(options), intake_(options.intake) {}
TeachSession::~TeachSession() = default;
TeachSession::TeachSession(TeachSession&&) noexcept = default;

Result<TeachStep> TeachSession::Observe(const Observation& observation) {
  if (auto checked = check_.Check(observation); !checked) return tl::unexpected(checked.error());
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
