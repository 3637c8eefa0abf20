#pragma once

#include <span>

#include "agent/session/replay_session.h"
#include "services/image/canvas.h"
#include "services/image/image.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// The frame as the robot understands it, enlarged to 640 pixels or more: each feature a disc in its
// verdict's colour (green inside its funnel lane, orange asks for right, blue for left, red
// rejected) with a line to where it will be at the milestone, a rejected one's to where it should
// be now; below, what was decided.
[[nodiscard]] image::RgbImage DrawFrameView(const image::GrayImage& frame, const ReplayStep& step,
                                            std::span<const replay::FeatureView> features);

[[nodiscard]] image::Color VerdictColor(replay::FeatureVerdict verdict);
// Where a feature's line leads.
[[nodiscard]] const route::TrackedFeature& TargetOf(const replay::FeatureView& feature);
[[nodiscard]] image::RgbImage InGrey(const image::GrayImage& frame);

}  // namespace trailcast::agent
