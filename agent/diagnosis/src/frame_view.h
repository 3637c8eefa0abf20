#pragma once

#include <cstddef>
#include <span>

#include "agent/diagnosis/src/verdict_color.h"
#include "agent/session/replay_session.h"
#include "services/image/canvas.h"
#include "services/image/image.h"
#include "services/replay/feature_view.h"

namespace trailcast::agent {

// Draws the frame as the robot understands it, enlarged to 640 pixels or more. Each feature is a
// disc in its verdict's colour (green inside its funnel lane, orange if it asks for right, blue for
// left, red if rejected) with a line to where it will be at the milestone, or for a rejected one to
// where it should be now. The decision is written below.
[[nodiscard]] image::RgbImage DrawFrameView(const image::GrayImage& frame, const ReplayStep& step,
                                            std::span<const replay::FeatureView> features);

// Other drawings of a frame share these.
inline constexpr image::Color kPanel{24, 24, 24};
inline constexpr image::Color kInk{235, 235, 235};
// A turn of this size fills half of the bar.
inline constexpr double kFullTurn_rad = 0.3;

// Converts pixels about the frame's centre to those of an enlarged picture.
struct Scaled {
  const image::GrayImage& frame;
  double times = 1.0;

  [[nodiscard]] image::PixelPoint At(const route::TrackedFeature& feature) const {
    return {(feature.u_px + 0.5 * frame.width) * times,
            (feature.v_px + 0.5 * frame.height) * times};
  }
};

// Draws each feature's line in its verdict's colour.
void DrawLines(image::Canvas& canvas, const Scaled& scaled,
               std::span<const replay::FeatureView> features);
[[nodiscard]] std::ptrdiff_t CountOf(std::span<const replay::FeatureView> features,
                                     replay::FeatureVerdict verdict);
// Returns where a feature's line leads.
[[nodiscard]] const route::TrackedFeature& TargetOf(const replay::FeatureView& feature);
[[nodiscard]] image::RgbImage InGrey(const image::GrayImage& frame);

}  // namespace trailcast::agent
