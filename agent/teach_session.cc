#include "agent/teach_session.h"

#include <tuple>
#include <utility>
#include <vector>

#include "agent/frame_check.h"
#include "services/vision/donut.h"

namespace trailcast::agent {
namespace {

// With fewer features than this in view a segment says nothing of where the path leads.
constexpr std::size_t kMinFeatures = 8;

}  // namespace

struct TeachSession::State {
  explicit State(const TeachOptions& options)
      : tracker(options.features),
        recorder(options.recorder),
        middle_features(options.middle_features) {}

  vision::DonutUnroller unroller;
  vision::FeatureTracker tracker;
  teach::SegmentRecorder recorder;
  int middle_features;
  FrameCheck check;
  // A segment is under way: with features, or blind, by odometry alone, until some come into view.
  enum class Recording { kNothing, kBlind, kFeatures } recording = Recording::kNothing;

  [[nodiscard]] bool SegmentEnds(const Observation& observation);
  void BeginSegment(const Observation& observation);
};

bool TeachSession::State::SegmentEnds(const Observation& observation) {
  const std::vector<route::TrackedFeature> tracked =
      tracker.Track(unroller.Unroll(observation.image));
  if (recording == Recording::kNothing) return false;
  if (recording == Recording::kFeatures) {
    return recorder.Add(observation.stamp, tracked, observation.odometry);
  }
  std::ignore = recorder.Add(observation.stamp, {}, observation.odometry);
  return tracker.Detect().size() >= kMinFeatures;
}

void TeachSession::State::BeginSegment(const Observation& observation) {
  tracker.Detect(observation.odometry ? middle_features : 0);
  std::vector<route::DescribedFeature> features = tracker.Describe();
  if (features.size() < kMinFeatures) {
    features.clear();
    tracker.Follow({});
  }
  recording = !features.empty()      ? Recording::kFeatures
              : observation.odometry ? Recording::kBlind
                                     : Recording::kNothing;
  if (recording != Recording::kNothing) {
    recorder.Begin(observation.stamp, std::move(features), observation.odometry);
  }
}

TeachSession::TeachSession(const TeachOptions& options)
    : state_(std::make_unique<State>(options)) {}
TeachSession::~TeachSession() = default;
TeachSession::TeachSession(TeachSession&&) noexcept = default;

Result<TeachStep> TeachSession::Observe(const Observation& observation) {
  State& s = *state_;
  if (auto checked = s.check.Check(observation); !checked) return tl::unexpected(checked.error());
  TeachStep step;
  if (s.SegmentEnds(observation)) {
    step.finished = s.recorder.Finish();
    s.BeginSegment(observation);
  } else if (s.recording == State::Recording::kNothing) {
    s.BeginSegment(observation);
  }
  step.features = s.tracker.count();
  step.too_few_features = s.recording != State::Recording::kFeatures;
  return step;
}

std::optional<route::Segment> TeachSession::Finish() {
  if (state_->recording == State::Recording::kNothing) return std::nullopt;
  state_->recording = State::Recording::kNothing;
  return state_->recorder.Finish();
}

}  // namespace trailcast::agent
