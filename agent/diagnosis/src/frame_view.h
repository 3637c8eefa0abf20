#pragma once

#include <cstddef>
#include <span>

#include "agent/diagnosis/src/verdict_color.h"
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

// What this and other drawings of a frame share.
inline constexpr image::Color kPanel{24, 24, 24};
inline constexpr image::Color kInk{235, 235, 235};
// A turn of this size fills half the bar below.
inline constexpr double kFullTurn_rad = 0.3;

// From pixels about the frame's centre to a picture so many times as large.
struct Scaled {
  const image::GrayImage& frame;
  double times = 1.0;

  [[nodiscard]] image::PixelPoint At(const route::TrackedFeature& feature) const {
    return {(feature.u_px + 0.5 * frame.width) * times,
            (feature.v_px + 0.5 * frame.height) * times};
  }
};

// Each feature's line, in its verdict's colour.
void DrawLines(image::Canvas& canvas, const Scaled& scaled,
               std::span<const replay::FeatureView> features);
[[nodiscard]] std::ptrdiff_t CountOf(std::span<const replay::FeatureView> features,
                                     replay::FeatureVerdict verdict);
// Where a feature's line leads.
[[nodiscard]] const route::TrackedFeature& TargetOf(const replay::FeatureView& feature);
[[nodiscard]] image::RgbImage InGrey(const image::GrayImage& frame);

}  // namespace trailcast::agent
