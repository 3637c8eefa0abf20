#include "agent/tool/run_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "agent/tool/plot_style.h"
#include "agent/tool/run_index.h"
#include "agent/tool/run_path_plot.h"
#include "agent/tool/story.h"
#include "agent/tool/strip_chart.h"

namespace trailcast::tool {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunLog;
using image::Canvas;
using image::Color;

constexpr Color kPale{150, 190, 215};

constexpr int kWidth_px = 1200;
constexpr double kLeft_px = 62.0;
constexpr double kRight_px = 22.0;
constexpr double kHead_px = 78.0;
constexpr double kGap_px = 38.0;  // between panels: a title and a legend fit
constexpr double kStripHeight_px = 150.0;
constexpr double kAxis_px = 48.0;
constexpr double kTextHeight_px = 11.0;
constexpr double kLeastDriven_m = 0.1;

Curve CurveOf(const RunLog& log, const std::string& label, Color color,
              std::optional<double> (*value)(const FrameRow&)) {
  Curve curve{label, color, {}};
  for (const FrameRow& row : log.frames) curve.values.push_back(value(row));
  return curve;
}

bool Any(const Curve& curve) {
  return std::any_of(curve.values.begin(), curve.values.end(),
                     [](const std::optional<double>& value) { return value.has_value(); });
}

void AddIfAny(StripChart& chart, Curve curve) {
  if (Any(curve)) chart.curves.push_back(std::move(curve));
}

StripChart Turns(const RunLog& log) {
  StripChart chart{"turn asked for [rad], positive to the right", {}, -0.05, 0.05};
  AddIfAny(chart, CurveOf(log, "by vision", kOrange,
                          [](const FrameRow& row) { return row.vision_turn_rad; }));
  AddIfAny(chart, CurveOf(log, "by odometry", kBlue,
                          [](const FrameRow& row) { return row.odometry_turn_rad; }));
  chart.curves.push_back(CurveOf(log, chart.curves.empty() ? "" : "together", kBlack,
                                 [](const FrameRow& row) { return std::optional(row.turn_rad); }));
  return chart;
}

StripChart Features(const RunLog& log) {
  StripChart chart{"share of the segment's features", {}, 0.0, 1.0};
  chart.curves.push_back(
      CurveOf(log, "in view", kPale, [](const FrameRow& row) -> std::optional<double> {
        if (row.stored == 0) return std::nullopt;
        return Share(row.tracked, row.stored);
      }));
  chart.curves.push_back(CurveOf(log, "agreeing with the route", kBlue,
                                 [](const FrameRow& row) -> std::optional<double> {
                                   if (row.stored == 0) return std::nullopt;
                                   return Share(row.agreeing, row.stored);
                                 }));
  return chart;
}

using Optional = std::optional<double> FrameRow::*;

void AddSigma(StripChart& chart, const RunLog& log, Optional value, Optional sigma) {
  for (const double side : {-1.0, 1.0}) {
    Curve curve{side > 0.0 ? "one sigma" : "", kPale, {}};
    for (const FrameRow& row : log.frames) {
      const bool known = row.*value && row.*sigma;
      curve.values.push_back(known ? std::optional(*(row.*value) + side * *(row.*sigma))
                                   : std::nullopt);
    }
    chart.curves.push_back(std::move(curve));
  }
}

StripChart Estimate(const RunLog& log) {
  StripChart chart{"estimated place beside the path [m], positive to the left", {}, -0.1, 0.1};
  AddSigma(chart, log, &FrameRow::left_m, &FrameRow::left_sigma_m);
  chart.curves.push_back(
      CurveOf(log, "estimate", kBlue, [](const FrameRow& row) { return row.left_m; }));
  AddIfAny(chart, CurveOf(log, "true distance (no side)", kOrange,
                          [](const FrameRow& row) { return row.true_off_m; }));
  return chart;
}

StripChart Delta(const RunLog& log) {
  StripChart chart{"how like the segment's end it is: delta", {}, 0.0, 1.0};
  chart.curves.push_back(CurveOf(log, "delta minus (like its start)", kPale,
                                 [](const FrameRow& row) { return row.delta_minus; }));
  chart.curves.push_back(
      CurveOf(log, "delta", kBlue, [](const FrameRow& row) { return row.delta; }));
  AddIfAny(chart, CurveOf(log, "true distance from the path [m]", kOrange,
                          [](const FrameRow& row) { return row.true_off_m; }));
  return chart;
}

StripChart Belief(const RunLog& log) {
  StripChart chart{"belief: place on the whole route, as a share of it", {}, 0.0, 1.0};
  AddSigma(chart, log, &FrameRow::place, &FrameRow::place_sigma);
  chart.curves.push_back(
      CurveOf(log, "place", kBlue, [](const FrameRow& row) { return row.place; }));
  chart.curves.push_back(CurveOf(log, "chance of being off it", kOrange,
                                 [](const FrameRow& row) { return row.off_route; }));
  return chart;
}

StripChart Speed(const RunLog& log) {
  StripChart chart{"speed told to the base [m/s]", {}, 0.0, 0.1};
  chart.curves.push_back(
      CurveOf(log, "", kGreen, [](const FrameRow& row) { return std::optional(row.linear_mps); }));
  return chart;
}

template <typename Predicate>
bool AnyFrame(const RunLog& log, Predicate holds) {
  return std::any_of(log.frames.begin(), log.frames.end(), holds);
}

// Those of which the method says something.
std::vector<StripChart> Charts(const RunLog& log) {
  std::vector<StripChart> charts{Turns(log)};
  if (AnyFrame(log, [](const FrameRow& row) { return row.stored > 0; })) {
    charts.push_back(Features(log));
  }
  if (AnyFrame(log, [](const FrameRow& row) { return row.left_m.has_value(); })) {
    charts.push_back(Estimate(log));
  } else if (AnyFrame(log, [](const FrameRow& row) { return row.delta.value_or(0.0) > 0.0; })) {
    charts.push_back(Delta(log));
  }
  if (AnyFrame(log, [](const FrameRow& row) { return row.place.has_value(); })) {
    charts.push_back(Belief(log));
  }
  charts.push_back(Speed(log));
  return charts;
}

// Metres; seconds for a robot that never got going, frames for one without odometry.
ChartAxis Axis(const RunLog& log) {
  const bool moved = HasOdometry(log) && PlaceOf(log.frames.back()) >= kLeastDriven_m;
  const bool stood = HasOdometry(log) && !moved;
  const auto place = [stood](const FrameRow& row) { return stood ? row.t_s : PlaceOf(row); };
  ChartAxis axis;
  axis.label = moved ? "driven [m]" : stood ? "time [s]" : "frame";
  for (const FrameRow& row : log.frames) axis.x.push_back(place(row));
  for (const Stay& stay : StaysOf(log)) axis.borders.push_back(place(log.frames[stay.first]));
  for (const Spell& spell : SpellsOf(log)) {
    if (spell.phase == Phase::kSure) continue;
    axis.bands.push_back({place(log.frames[spell.first]), place(log.frames[spell.end - 1]),
                          PhaseColor(spell.phase)});
  }
  return axis;
}

// Who, what came of it, and what the bands mean.
void DrawHead(Canvas& canvas, const RunLog& log) {
  canvas.Text(WhoFollowedWhat(log), {kLeft_px, 22.0}, kTextHeight_px, kInk);
  canvas.Text(Outcome(log), {kLeft_px, 42.0}, kTextHeight_px, kInk);
  double x = kLeft_px;
  for (const Phase phase : {Phase::kUnsure, Phase::kDistant, Phase::kBlind, Phase::kCovered,
                            Phase::kSeeking, Phase::kWaiting, Phase::kArrived, Phase::kLost}) {
    canvas.FillBox({x, 50.0}, {x + 22.0, 62.0}, PhaseColor(phase));
    canvas.Text(ToString(phase), {x + 28.0, 60.0}, 10.0, kInk);
    x += 46.0 + Canvas::TextWidth(ToString(phase), 10.0);
  }
}

}  // namespace

Color PhaseColor(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return {222, 222, 222};
    case Phase::kSeeking:
      return {190, 220, 250};
    case Phase::kUnsure:
      return {255, 236, 170};
    case Phase::kDistant:
      return {225, 235, 205};
    case Phase::kBlind:
      return {255, 200, 140};
    case Phase::kCovered:
      return {220, 195, 240};
    case Phase::kArrived:
      return {195, 235, 195};
    case Phase::kLost:
      return {250, 170, 170};
    case Phase::kSure:
      break;
  }
  return kWhite;
}

image::RgbImage DrawRun(const RunLog& log) {
  const double width = kWidth_px - kLeft_px - kRight_px;
  const double path_height = PathPanelHeight(log, width);
  const double paths = path_height > 0.0 ? kGap_px + path_height : 0.0;
  const std::vector<StripChart> charts = Charts(log);
  const double strips = static_cast<double>(charts.size()) * (kGap_px + kStripHeight_px);
  Canvas canvas(kWidth_px, static_cast<int>(kHead_px + paths + strips + kAxis_px), kWhite);
  DrawHead(canvas, log);
  double top = kHead_px + 14.0;
  if (path_height > 0.0) {
    DrawPathPanel(canvas, {kLeft_px, top, width, path_height}, log);
    top += path_height + kGap_px + 8.0;
  }
  const ChartAxis axis = Axis(log);
  PixelBox box{kLeft_px, top, width, kStripHeight_px};
  for (const StripChart& chart : charts) {
    DrawStrip(canvas, box, axis, chart);
    if (&chart == &charts.back()) DrawChartAxis(canvas, box, axis);
    box.top += kStripHeight_px + kGap_px;
  }
  return canvas.picture();
}

}  // namespace trailcast::tool
