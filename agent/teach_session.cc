#include "agent/teach_session.h"

#include <utility>
#include <vector>

#include "agent/frame_check.h"
#include "services/teach/segment_recorder.h"
#include "services/vision/feature_tracker.h"

namespace trailcast::agent {
namespace {

// With fewer features than this in view a segment says nothing of where the path leads.
constexpr std::size_t kMinFeatures = 8;

}  // namespace

struct TeachSession::State {
  vision::FeatureTracker tracker;
  teach::SegmentRecorder recorder;
  FrameCheck check;
  bool recording = false;  // a segment is under way

  // Detects features in the last frame and begins a segment with them. False: too few.
  bool BeginSegment(const Observation& observation);
};

bool TeachSession::State::BeginSegment(const Observation& observation) {
  tracker.Detect();
  std::vector<route::DescribedFeature> features = tracker.Describe();
  recording = features.size() >= kMinFeatures;
  if (recording) recorder.Begin(observation.stamp, std::move(features), observation.odometry);
  return recording;
}

TeachSession::TeachSession() : state_(std::make_unique<State>()) {}
TeachSession::~TeachSession() = default;
TeachSession::TeachSession(TeachSession&&) noexcept = default;

Result<TeachStep> TeachSession::Observe(const Observation& observation) {
  State& s = *state_;
  if (auto checked = s.check.Check(observation); !checked) return tl::unexpected(checked.error());
  const std::vector<route::TrackedFeature> tracked = s.tracker.Track(observation.image);
  TeachStep step;
  if (s.recording) {
    const bool ends = s.recorder.Add(observation.stamp, tracked, observation.odometry);
    step.features = static_cast<int>(tracked.size());
    if (!ends) return step;
    step.finished = s.recorder.Finish();
  }
  step.too_few_features = !s.BeginSegment(observation);
  return step;
}

std::optional<route::Segment> TeachSession::Finish() {
  State& s = *state_;
  if (!s.recording) return std::nullopt;
  s.recording = false;
  return s.recorder.Finish();
}

}  // namespace trailcast::agent
