#include "agent/diagnosis/src/frame_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace trailcast::agent {
namespace {

using image::Canvas;
using replay::FeatureVerdict;

constexpr int kLeastWidth_px = 640;
constexpr int kPanelHeight_px = 96;
constexpr double kTextHeight_px = 11.0;
constexpr double kLine_px = 22.0;
constexpr double kMargin_px = 10.0;
// Draws from the middle to the side of the turn.
void DrawTurn(Canvas& canvas, double turn_rad, double y) {
  const double half = 0.5 * canvas.picture().width;
  const double share = std::clamp(turn_rad / kFullTurn_rad, -1.0, 1.0);
  canvas.Line({{half, y}, {half + share * (half - kMargin_px), y}},
              VerdictColor(turn_rad > 0.0 ? FeatureVerdict::kAsksRight : FeatureVerdict::kAsksLeft),
              6.0);
  canvas.Line({{half, y - 6.0}, {half, y + 6.0}}, kInk, 1.0);
}

void DrawLegend(Canvas& canvas, const ReplayStep& step,
                std::span<const replay::FeatureView> features, double baseline) {
  struct Entry {
    const char* text;
    FeatureVerdict verdict;
  };
  const std::string all = fmt::format("{} of {}:", features.size(), step.sight.stored);
  canvas.Text(all, {kMargin_px, baseline}, kTextHeight_px, kInk);
  double x = kMargin_px + Canvas::TextWidth(all, kTextHeight_px) + 12.0;
  for (const Entry& entry : {Entry{"in funnel lane", FeatureVerdict::kInside},
                             Entry{"ask left", FeatureVerdict::kAsksLeft},
                             Entry{"ask right", FeatureVerdict::kAsksRight},
                             Entry{"rejected", FeatureVerdict::kRejected}}) {
    canvas.Disc({x + 4.0, baseline - 0.5 * kTextHeight_px}, 4.0, VerdictColor(entry.verdict));
    const std::string text = fmt::format("{} {}", CountOf(features, entry.verdict), entry.text);
    canvas.Text(text, {x + 14.0, baseline}, kTextHeight_px, kInk);
    x += Canvas::TextWidth(text, kTextHeight_px) + 26.0;
  }
}

std::string Where(const ReplayStep& step) {
  return fmt::format("{} ({})   segment {}, {:.0f} % of it   {:.2f} m/s", ToString(step.state),
                     ToString(step.trust), step.segment.value(), 100.0 * step.fraction,
                     step.command.linear_mps);
}

std::string Turn(const ReplayStep& step) {
  const replay::FollowStep& decision = step.decision;
  std::string text = fmt::format("turn {:.3f} rad {}", std::abs(step.turn_rad),
                                 step.turn_rad > 0.0 ? "right" : "left");
  if (decision.offset) {
    text += fmt::format("   {:.2f} m {} of the path, +- {:.2f}", std::abs(decision.offset->left_m),
                        decision.offset->left_m > 0.0 ? "left" : "right",
                        decision.offset->left_sigma_m);
  } else {
    text += fmt::format("   vision {:+.3f}, odometry {:+.3f}   delta {:.2f}, {:.2f}",
                        decision.vision_turn_rad, decision.odometry_turn_rad, decision.delta,
                        decision.delta_minus);
  }
  return text;
}

}  // namespace

void DrawLines(Canvas& canvas, const Scaled& scaled,
               std::span<const replay::FeatureView> features) {
  for (const replay::FeatureView& feature : features) {
    canvas.Line({scaled.At(feature.at), scaled.At(TargetOf(feature))},
                VerdictColor(feature.verdict), 1.0);
  }
}

std::ptrdiff_t CountOf(std::span<const replay::FeatureView> features, FeatureVerdict verdict) {
  return std::count_if(features.begin(), features.end(),
                       [&](const auto& feature) { return feature.verdict == verdict; });
}

const route::TrackedFeature& TargetOf(const replay::FeatureView& feature) {
  return feature.verdict == FeatureVerdict::kRejected ? feature.expected : feature.milestone;
}

image::RgbImage InGrey(const image::GrayImage& frame) {
  image::RgbImage picture{frame.width, frame.height, {}};
  picture.pixels.reserve(3 * frame.pixels.size());
  for (const std::uint8_t grey : frame.pixels) picture.pixels.insert(picture.pixels.end(), 3, grey);
  return picture;
}

image::RgbImage DrawFrameView(const image::GrayImage& frame, const ReplayStep& step,
                              std::span<const replay::FeatureView> features) {
  int times = 1;
  while (times * frame.width < kLeastWidth_px) ++times;
  const int width = times * frame.width;
  const int height = times * frame.height;
  Canvas canvas(width, height + kPanelHeight_px, kPanel);
  canvas.Paste(InGrey(frame), 0, 0, width, height);
  const Scaled enlarged{frame, static_cast<double>(times)};
  DrawLines(canvas, enlarged, features);
  for (const replay::FeatureView& feature : features) {
    canvas.Disc(enlarged.At(feature.at), 4.0, VerdictColor(feature.verdict));
  }
  // Lines to places outside the picture, where milestones often are, must not cross the text.
  canvas.FillBox({0.0, static_cast<double>(height)},
                 {static_cast<double>(width), static_cast<double>(height + kPanelHeight_px)},
                 kPanel);
  DrawTurn(canvas, step.turn_rad, height + 12.0);
  double y = height + 38.0;
  canvas.Text(Where(step), {kMargin_px, y}, kTextHeight_px, kInk);
  canvas.Text(Turn(step), {kMargin_px, y += kLine_px}, kTextHeight_px, kInk);
  DrawLegend(canvas, step, features, y + kLine_px);
  return canvas.picture();
}

}  // namespace trailcast::agent
