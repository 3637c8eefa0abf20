#include "agent/diagnosis/snapshot_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "agent/diagnosis/src/frame_view.h"
#include "services/base/angles.h"

namespace trailcast::agent {
namespace {

using image::Canvas;
using image::Color;
using image::PixelPoint;
using replay::FeatureVerdict;

constexpr int kMostWidth_px = 320;
constexpr int kStrip_px = 16;
constexpr double kMark_px = 3.5;

void DrawMark(Canvas& canvas, PixelPoint at, FeatureVerdict verdict) {
  const Color color = VerdictColor(verdict);
  const auto triangle = [&](double tip) {
    canvas.FillPolygon(
        {{at.x + tip, at.y}, {at.x - tip, at.y - kMark_px}, {at.x - tip, at.y + kMark_px}}, color);
  };
  switch (verdict) {
    case FeatureVerdict::kInside:
      return canvas.Disc(at, kMark_px - 1.0, color);
    case FeatureVerdict::kAsksRight:
      return triangle(kMark_px);
    case FeatureVerdict::kAsksLeft:
      return triangle(-kMark_px);
    case FeatureVerdict::kRejected:
      return canvas.Cross(at, kMark_px, color, 1.0);
  }
}

void DrawTurn(Canvas& canvas, double turn_rad, int top) {
  const double width = canvas.picture().width;
  const double y = top + 0.5 * kStrip_px;
  canvas.FillBox({0.0, static_cast<double>(top)}, {width, static_cast<double>(top + kStrip_px)},
                 kPanel);
  canvas.Line({{0.5 * width, y - 5.0}, {0.5 * width, y + 5.0}}, kInk, 1.0);
  const double share = std::clamp(turn_rad / kFullTurn_rad, -1.0, 1.0);
  const double tip = (0.5 + 0.48 * share) * width;
  const double back = std::copysign(std::min(5.0, std::abs(tip - 0.5 * width)), share);
  const Color color =
      VerdictColor(turn_rad > 0.0 ? FeatureVerdict::kAsksRight : FeatureVerdict::kAsksLeft);
  canvas.Line({{0.5 * width, y}, {tip - back, y}}, color, 3.0);
  canvas.FillPolygon({{tip, y}, {tip - back, y - 5.0}, {tip - back, y + 5.0}}, color);
}

}  // namespace

image::RgbImage DrawSnapshot(const SnapshotFrame& frame) {
  const image::GrayImage& picture = frame.picture;
  if (picture.empty()) return {};
  const Scaled scaled{picture, std::min(1.0, static_cast<double>(kMostWidth_px) / picture.width)};
  const int width = std::max(1, static_cast<int>(std::lround(scaled.times * picture.width)));
  const int height = std::max(1, static_cast<int>(std::lround(scaled.times * picture.height)));
  Canvas canvas(width, height + (frame.turn_rad ? kStrip_px : 0), kPanel);
  canvas.Paste(InGrey(picture), 0, 0, width, height);
  DrawLines(canvas, scaled, frame.features);
  for (const replay::FeatureView& feature : frame.features) {
    DrawMark(canvas, scaled.At(feature.at), feature.verdict);
  }
  if (frame.turn_rad) DrawTurn(canvas, *frame.turn_rad, height);
  return canvas.picture();
}

std::string SnapshotText(const SnapshotFrame& frame) {
  if (!frame.turn_rad) return "no turn is asked for";
  const auto count = [&](FeatureVerdict verdict) { return CountOf(frame.features, verdict); };
  std::string text = fmt::format("turns {:.1f} degrees {}", Degrees(std::abs(*frame.turn_rad)),
                                 *frame.turn_rad > 0.0 ? "right" : "left");
  if (!frame.marked()) return text;
  return text + fmt::format(
                    "; {} of {} features: {} in their funnel lanes, {} ask for left, "
                    "{} for right, {} rejected",
                    frame.features.size(), frame.stored, count(FeatureVerdict::kInside),
                    count(FeatureVerdict::kAsksLeft), count(FeatureVerdict::kAsksRight),
                    count(FeatureVerdict::kRejected));
}

}  // namespace trailcast::agent
