#include "services/explain/run_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "services/explain/src/run_index.h"
#include "services/explain/src/run_path_plot.h"
#include "services/explain/story.h"
#include "services/plot/plot_style.h"
#include "services/plot/strip_chart.h"

namespace trailcast::explain {
namespace {

using agent::FrameRow;
using agent::Phase;
using agent::RunLog;
using image::Color;
using plot::Drawing;

constexpr Color kPale{150, 190, 215};

constexpr int kWidth_px = 1200;
constexpr double kLeft_px = 62.0;
constexpr double kRight_px = 22.0;
constexpr double kHead_px = 78.0;
constexpr double kGap_px = 38.0;  // a title and a legend fit between panels
constexpr double kStripHeight_px = 150.0;
constexpr double kAxis_px = 48.0;
constexpr double kPlotTextHeight_px = 11.0;
constexpr double kLeastPlotted_m = 0.1;

plot::Curve CurveOf(const RunLog& log, const std::string& label, Color color,
                    std::optional<double> (*value)(const FrameRow&)) {
  plot::Curve curve{label, color, {}};
  for (const FrameRow& row : log.frames) curve.values.push_back(value(row));
  return curve;
}

bool Any(const plot::Curve& curve) {
  return std::any_of(curve.values.begin(), curve.values.end(),
                     [](const std::optional<double>& value) { return value.has_value(); });
}

void AddIfAny(plot::StripChart& chart, plot::Curve curve) {
  if (Any(curve)) chart.curves.push_back(std::move(curve));
}

plot::StripChart Turns(const RunLog& log) {
  plot::StripChart chart{"turn asked for [rad], positive to the right", {}, -0.05, 0.05};
  AddIfAny(chart, CurveOf(log, "by vision", plot::kOrange,
                          [](const FrameRow& row) { return row.vision_turn_rad; }));
  AddIfAny(chart, CurveOf(log, "by odometry", plot::kBlue,
                          [](const FrameRow& row) { return row.odometry_turn_rad; }));
  chart.curves.push_back(CurveOf(log, chart.curves.empty() ? "" : "together", plot::kBlack,
                                 [](const FrameRow& row) { return std::optional(row.turn_rad); }));
  return chart;
}

plot::StripChart Features(const RunLog& log) {
  plot::StripChart chart{"share of the segment's features", {}, 0.0, 1.0};
  chart.curves.push_back(
      CurveOf(log, "in view", kPale, [](const FrameRow& row) -> std::optional<double> {
        if (row.stored == 0) return std::nullopt;
        return Share(row.tracked, row.stored);
      }));
  chart.curves.push_back(CurveOf(log, "agreeing with the route", plot::kBlue,
                                 [](const FrameRow& row) -> std::optional<double> {
                                   if (row.stored == 0) return std::nullopt;
                                   return Share(row.agreeing, row.stored);
                                 }));
  return chart;
}

using Optional = std::optional<double> FrameRow::*;

void AddSigma(plot::StripChart& chart, const RunLog& log, Optional value, Optional sigma) {
  for (const double side : {-1.0, 1.0}) {
    plot::Curve curve{side > 0.0 ? "one sigma" : "", kPale, {}};
    for (const FrameRow& row : log.frames) {
      const bool known = row.*value && row.*sigma;
      curve.values.push_back(known ? std::optional(*(row.*value) + side * *(row.*sigma))
                                   : std::nullopt);
    }
    chart.curves.push_back(std::move(curve));
  }
}

plot::StripChart Estimate(const RunLog& log) {
  plot::StripChart chart{
      "estimated place beside the path [m], positive to the left", {}, -0.1, 0.1};
  AddSigma(chart, log, &FrameRow::left_m, &FrameRow::left_sigma_m);
  chart.curves.push_back(
      CurveOf(log, "estimate", plot::kBlue, [](const FrameRow& row) { return row.left_m; }));
  AddIfAny(chart, CurveOf(log, "true distance (no side)", plot::kOrange,
                          [](const FrameRow& row) { return row.true_off_m; }));
  return chart;
}

plot::StripChart Delta(const RunLog& log) {
  plot::StripChart chart{"how like the segment's end it is: delta", {}, 0.0, 1.0};
  chart.curves.push_back(CurveOf(log, "delta minus (like its start)", kPale,
                                 [](const FrameRow& row) { return row.delta_minus; }));
  chart.curves.push_back(
      CurveOf(log, "delta", plot::kBlue, [](const FrameRow& row) { return row.delta; }));
  AddIfAny(chart, CurveOf(log, "true distance from the path [m]", plot::kOrange,
                          [](const FrameRow& row) { return row.true_off_m; }));
  return chart;
}

plot::StripChart Belief(const RunLog& log) {
  plot::StripChart chart{"belief: place on the whole route, as a share of it", {}, 0.0, 1.0};
  AddSigma(chart, log, &FrameRow::place, &FrameRow::place_sigma);
  chart.curves.push_back(
      CurveOf(log, "place", plot::kBlue, [](const FrameRow& row) { return row.place; }));
  chart.curves.push_back(CurveOf(log, "chance of being off it", plot::kOrange,
                                 [](const FrameRow& row) { return row.off_route; }));
  return chart;
}

plot::StripChart Odometry(const RunLog& log) {
  plot::StripChart chart{"odometry: how far it is believed, and its scale", {}, 0.0, 1.0};
  chart.curves.push_back(CurveOf(log, "believed", plot::kBlue,
                                 [](const FrameRow& row) { return row.odometry_trust; }));
  chart.curves.push_back(CurveOf(log, "the route's metres for each of its own", plot::kOrange,
                                 [](const FrameRow& row) { return row.odometry_scale; }));
  return chart;
}

plot::StripChart Speed(const RunLog& log) {
  plot::StripChart chart{"speed told to the base [m/s]", {}, 0.0, 0.1};
  chart.curves.push_back(CurveOf(
      log, "", plot::kGreen, [](const FrameRow& row) { return std::optional(row.linear_mps); }));
  return chart;
}

template <typename Predicate>
bool AnyFrame(const RunLog& log, Predicate holds) {
  return std::any_of(log.frames.begin(), log.frames.end(), holds);
}

// Returns the charts for which the method gives values.
std::vector<plot::StripChart> Charts(const RunLog& log) {
  std::vector<plot::StripChart> charts{Turns(log)};
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
  if (AnyFrame(log, [](const FrameRow& row) { return row.odometry_trust.has_value(); })) {
    charts.push_back(Odometry(log));
  }
  charts.push_back(Speed(log));
  return charts;
}

// The axis has metres, or seconds for a robot that never drove off, or frames for one without
// odometry.
plot::ChartAxis Axis(const RunLog& log) {
  const bool moved = HasOdometry(log) && PlaceOf(log.frames.back()) >= kLeastPlotted_m;
  const bool stood = HasOdometry(log) && !moved;
  const auto place = [stood](const FrameRow& row) { return stood ? row.t_s : PlaceOf(row); };
  plot::ChartAxis axis;
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

// Writes who followed which route, the outcome, and what the bands mean.
void DrawHead(Drawing& drawing, const RunLog& log) {
  drawing.Text(WhoFollowedWhat(log), {kLeft_px, 22.0}, kPlotTextHeight_px, plot::kInk);
  drawing.Text(Outcome(log), {kLeft_px, 42.0}, kPlotTextHeight_px, plot::kInk);
  double x = kLeft_px;
  for (const Phase phase :
       {Phase::kUnsure, Phase::kDistant, Phase::kBlind, Phase::kCovered, Phase::kSeeking,
        Phase::kLooking, Phase::kWaiting, Phase::kArrived, Phase::kLost}) {
    drawing.FillBox({x, 50.0}, {x + 22.0, 62.0}, PhaseColor(phase));
    drawing.Text(ToString(phase), {x + 28.0, 60.0}, 10.0, plot::kInk);
    x += 46.0 + Drawing::TextWidth(ToString(phase), 10.0);
  }
}

}  // namespace

Color PhaseColor(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return {222, 222, 222};
    case Phase::kSeeking:
      return {190, 220, 250};
    case Phase::kLooking:
      return {165, 205, 215};
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
  return plot::kWhite;
}

Drawing DrawRun(const RunLog& log) {
  const double width = kWidth_px - kLeft_px - kRight_px;
  const double path_height = PathPanelHeight(log, width);
  const double paths = path_height > 0.0 ? kGap_px + path_height : 0.0;
  const std::vector<plot::StripChart> charts = Charts(log);
  const double strips = static_cast<double>(charts.size()) * (kGap_px + kStripHeight_px);
  Drawing drawing(kWidth_px, static_cast<int>(kHead_px + paths + strips + kAxis_px), plot::kWhite);
  DrawHead(drawing, log);
  double top = kHead_px + 14.0;
  if (path_height > 0.0) {
    DrawPathPanel(drawing, {kLeft_px, top, width, path_height}, log);
    top += path_height + kGap_px + 8.0;
  }
  const plot::ChartAxis axis = Axis(log);
  plot::PixelBox box{kLeft_px, top, width, kStripHeight_px};
  for (const plot::StripChart& chart : charts) {
    plot::DrawStrip(drawing, box, axis, chart);
    if (&chart == &charts.back()) plot::DrawChartAxis(drawing, box, axis);
    box.top += kStripHeight_px + kGap_px;
  }
  return drawing;
}

}  // namespace trailcast::explain
