#include "agent/diagnosis/run_recorder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

Phase PhaseOf(const ReplayStep& step) {
  if (Waits(step.state)) return Phase::kWaiting;
  if (step.state == ReplayState::kArrived) return Phase::kArrived;
  switch (step.trust) {
    case Trust::kSure:
      return Phase::kSure;
    case Trust::kUnsure:
      return Phase::kUnsure;
    case Trust::kDistant:
      return Phase::kDistant;
    case Trust::kBlind:
      return Phase::kBlind;
    case Trust::kCovered:
      return Phase::kCovered;
    case Trust::kSeeking:
      return Phase::kSeeking;
    case Trust::kLooking:
      return Phase::kLooking;
    case Trust::kLost:
      break;
  }
  return Phase::kLost;
}

const char* WhatOf(SearchKind kind) {
  switch (kind) {
    case SearchKind::kHandOver:
      return "hand-over";
    case SearchKind::kLookedAgain:
      return "looked-again";
    case SearchKind::kRecovered:
      break;
  }
  return "recovered";
}

// The widened funnel gives the robot's place; the paper's method gives two halves of a turn and
// delta.
void FillDecision(const replay::FollowStep& decision, bool odometry, FrameRow& row) {
  if (decision.offset) {
    row.left_m = decision.offset->left_m;
    row.left_sigma_m = decision.offset->left_sigma_m;
    row.heading_rad = decision.offset->heading_rad;
    row.along_m = decision.offset->along_m;
    row.mount_yaw_rad = decision.mount_yaw_rad;
    return;
  }
  row.vision_turn_rad = decision.vision_turn_rad;
  if (odometry) row.odometry_turn_rad = decision.odometry_turn_rad;
  row.delta = decision.delta;
  row.delta_minus = decision.delta_minus;
}

}  // namespace

Fields RunRecorder::Begin(const RunFacts& facts) {
  const route::RouteInfo& route = facts.route;
  Fields header;
  header.Add("route", route.name);
  header.Add("revision", std::to_string(route.revision.value()));
  header.Add("segments", std::to_string(route.segment_count));
  header.Add("length_m", fmt::format("{:.2f}", route.length_m));
  header.Add("scout", route.scout.value());
  header.Add("scout_camera", route.camera);
  header.Add("robot", facts.robot);
  header.Add("camera", facts.camera);
  header.Add("method", facts.method);
  return header;
}

FrameRow RunRecorder::RowOf(const RunFrame& frame, const ReplayStep& step) const {
  FrameRow row;
  row.frame = frames_;
  row.t_s = t_s_;
  row.segment = static_cast<int>(step.segment.value());
  row.fraction = step.fraction;
  row.progress = step.progress;
  row.phase = PhaseOf(step);
  row.stored = step.sight.stored;
  row.tracked = step.features;
  // At a hand-over the method has judged the last segment's features, not yet this one's.
  const bool judged = step.sight.searches.empty() || frames_ == 0;
  row.agreeing = judged ? step.decision.agreeing : step.features;
  row.rejected = step.decision.rejected;
  row.rejected_by_px = step.decision.rejected_by_px;
  row.left_picture = step.sight.lost.left_picture;
  row.not_returned = step.sight.lost.not_returned;
  row.turn_rad = step.turn_rad;
  FillDecision(step.decision, frame.odometry.has_value(), row);
  row.magnification = step.magnification;
  if (frame.odometry) {
    row.driven_m = driven_m_;
    row.x_m = frame.odometry->x_m;
    row.y_m = frame.odometry->y_m;
  }
  row.linear_mps = step.command.linear_mps;
  row.angular_radps = step.command.angular_radps;
  row.cpu_ms = frame.cpu_ms;
  row.true_off_m = frame.true_off_m;
  if (step.believed) {
    row.place = step.believed->place;
    row.place_sigma = step.believed->sigma;
    row.off_route = step.believed->off_route;
  }
  row.evidence = step.evidence;
  if (step.odometry) {
    row.odometry_trust = step.odometry->trust;
    row.odometry_scale = step.odometry->scale;
  }
  return row;
}

RunEvent RunRecorder::EventNow(const std::string& what) const {
  RunEvent event;
  event.frame = std::max(0, frames_ - 1);
  event.t_s = t_s_;
  event.what = what;
  return event;
}

RunEvent RunRecorder::SearchEvent(const Search& search, double magnification) const {
  RunEvent event = EventNow(WhatOf(search.kind));
  event.fields.Add("segment", std::to_string(search.segment.value()));
  event.fields.Add("found", std::to_string(search.found));
  event.fields.Add("stored", std::to_string(search.stored));
  event.fields.Add("search", search.wide ? "wide" : "near");
  if (search.kind != SearchKind::kLookedAgain) {
    event.fields.Add("length_m", fmt::format("{:.3f}", search.length_m));
    event.fields.Add("speed_mps", fmt::format("{:.3f}", search.speed_mps));
    event.fields.Add("magnification", fmt::format("{:.3f}", magnification));
  }
  return event;
}

RecordedFrame RunRecorder::Add(const RunFrame& frame, const ReplayStep& step) {
  t_s_ = Seconds(frame.stamp);
  if (frame.odometry && odometry_) {
    driven_m_ += std::abs(motion::IncrementBetween(*odometry_, *frame.odometry).distance_m);
  }
  odometry_ = frame.odometry;
  RecordedFrame recorded{RowOf(frame, step), {}};
  const FrameRow& row = recorded.row;
  ++frames_;
  if (step.decision.carried_left_m) {
    RunEvent carried = EventNow("carried");
    carried.fields.Add("segment", std::to_string(row.segment));
    carried.fields.Add("left_m", fmt::format("{:.2f}", *step.decision.carried_left_m));
    recorded.events.push_back(std::move(carried));
  }
  for (const Search& search : step.sight.searches) {
    recorded.events.push_back(SearchEvent(search, step.magnification));
  }
  if (phase_ != row.phase) {
    RunEvent change = EventNow("phase");
    if (phase_) change.fields.Add("from", ToString(*phase_));
    change.fields.Add("to", ToString(row.phase));
    change.fields.Add("segment", std::to_string(row.segment));
    change.text = step.reason;
    recorded.events.push_back(std::move(change));
  }
  phase_ = row.phase;
  return recorded;
}

RunEvent RunRecorder::Note(const std::string& what, const std::string& text) const {
  RunEvent event = EventNow(what);
  event.text = text;
  return event;
}

RunEvent RunRecorder::End(const std::string& state, const std::string& reason) const {
  RunEvent event = EventNow("end");
  event.fields.Add("state", state);
  event.text = reason;
  return event;
}

}  // namespace trailcast::agent
