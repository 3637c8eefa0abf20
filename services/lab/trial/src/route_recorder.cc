#include "services/lab/trial/route_recorder.h"

#include <utility>

#include "services/route/digest.h"

namespace trailcast::trial {

RouteRecorder::RouteRecorder(const std::string& name, const std::string& camera,
                             const agent::TeachOptions& options)
    : intake_(options.intake), session_(options) {
  // Its id need not differ from others'.
  taught_.info.key = {RouteId("00000000000000000000000000000000"), TeachingId(1)};
  taught_.info.name = name;
  taught_.info.scout = AgentId("scout");
  taught_.info.camera = camera;
}

Result<void> RouteRecorder::Observe(const agent::Observation& seen) {
  camera_ = {seen.image.width, seen.image.height};
  has_odometry_ = seen.odometry.has_value();
  if (session_.frame() < 0) SetSize(intake_);
  const auto step = session_.Observe(seen);
  if (!step) return tl::unexpected(step.error());
  Take(*step);
  if (const auto more = session_.CatchUp()) Take(*more);
  return {};
}

void RouteRecorder::Take(const agent::TeachStep& step) {
  if (step.anew) {
    SetSize(step.anew->intake);
    taught_.pieces.clear();
    taught_.ground = {};
    taught_.info.segment_count = 0;
    taught_.info.length_m = 0.0;
    taught_.info.bytes = 0;
    spans_.clear();
    began_.reset();
    return;
  }
  Keep(step.finished, session_.frame());
  // With odometry, a segment is under way even where there is nothing to see.
  const bool under_way = !step.too_few_features || has_odometry_;
  if (!began_ && under_way) began_ = session_.frame();
}

void RouteRecorder::SetSize(const vision::IntakeOptions& intake) {
  const auto size = vision::WorkingSize(camera_, intake);
  taught_.info.image_width_px = size.width;
  taught_.info.image_height_px = size.height;
}

Result<TaughtRoute> RouteRecorder::Finish() {
  while (const auto step = session_.CatchUp()) Take(*step);
  Keep(session_.Finish(), session_.frame());
  if (taught_.pieces.empty()) {
    return Fail(ErrorCode::kUnavailable,
                "teaching gave no segment: the scout's camera saw nothing to hold on to");
  }
  taught_.info.state = route::RouteState::kComplete;
  return std::move(taught_);
}

void RouteRecorder::Keep(const std::optional<route::Segment>& segment, int last_frame) {
  if (!segment) return;
  taught_.pieces.push_back(route::MakePiece(taught_.info.key, *segment));
  taught_.ground.Add(*segment);
  taught_.info.segment_count += 1;
  taught_.info.length_m += segment->length_m;
  taught_.info.bytes += taught_.pieces.back().bytes.size();
  spans_.push_back({began_.value_or(last_frame), last_frame});
  began_.reset();
}

}  // namespace trailcast::trial
