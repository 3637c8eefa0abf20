#include "services/lab/trial/judge/recording_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/lab/trial/judge/recording_report.h"
#include "services/plot/plot_style.h"
#include "services/plot/strip_chart.h"

namespace trailcast::trial {
namespace {

using image::Color;
using plot::Drawing;

constexpr int kWidth_px = 1200;
constexpr double kLeft_px = 62.0;
constexpr double kRight_px = 22.0;
constexpr double kHead_px = 40.0;
constexpr double kGap_px = 30.0;   // for the title above a strip
constexpr double kAxis_px = 46.0;  // below a replay's strips
constexpr double kStripHeight_px = 150.0;
constexpr Color kTruth{150, 150, 150};

constexpr std::array<std::pair<Claim, const char*>, 3> kBands{
    {{Claim::kUnsure, "unsure: blind, seeking, waiting"},
     {Claim::kLost, "lost"},
     {Claim::kArrived, "arrived"}}};

Color ColorOf(Claim claim) {
  switch (claim) {
    case Claim::kUnsure:
      return {255, 236, 170};
    case Claim::kLost:
      return {250, 170, 170};
    case Claim::kArrived:
      return {195, 235, 195};
    case Claim::kFollowing:
      break;
  }
  return plot::kWhite;
}

plot::ChartAxis AxisOf(const RecordingOutcome& outcome) {
  plot::ChartAxis axis;
  axis.label = "frame shown";
  const Replayed& replayed = outcome.replayed;
  for (std::size_t i = 0; i < replayed.shown.size(); ++i) {
    axis.x.push_back(static_cast<double>(i));
    if (replayed.shown[i].cut) axis.borders.push_back(static_cast<double>(i));
  }
  for (std::size_t i = 0; i < replayed.said.size();) {
    const Claim claim = replayed.said[i].claim;
    std::size_t end = i;
    while (end < replayed.said.size() && replayed.said[end].claim == claim) ++end;
    if (claim != Claim::kFollowing) {
      axis.bands.push_back({static_cast<double>(i), static_cast<double>(end), ColorOf(claim)});
    }
    i = end;
  }
  return axis;
}

std::string TitleOf(const RecordingRow& row) {
  const RecordingShares shares = SharesOf(row.verdict);
  std::string title = fmt::format("{} on {}", row.replay, row.teach);
  if (row.disturbance != "none") title += ", " + row.disturbance;
  title += fmt::format(": following {:.2f}", shares.following.value_or(0.0));
  if (shares.right)
    title += fmt::format(", right {:.2f}, wrong {:.2f}", *shares.right, *shares.wrong);
  return title;
}

// The truth is known for some frames only, and drawn as a line in between.
plot::Curve TruthOf(const RecordingOutcome& outcome) {
  constexpr std::size_t kWidestGap = 20;  // frames
  plot::Curve truth{"truth", kTruth, std::vector<std::optional<double>>(outcome.truth.size()), 5.0};
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < outcome.truth.size(); ++i) {
    if (outcome.replayed.shown[i].cut) last.reset();
    if (!outcome.truth[i]) continue;
    const double here = outcome.truth[i]->teach_frame;
    truth.values[i] = here;
    if (last && i - *last <= kWidestGap) {
      const double before = *truth.values[*last];
      for (std::size_t k = *last + 1; k < i; ++k) {
        truth.values[k] = before + (here - before) * static_cast<double>(k - *last) /
                                       static_cast<double>(i - *last);
      }
    }
    last = i;
  }
  return truth;
}

plot::StripChart PlaceChart(const RecordingOutcome& outcome) {
  plot::StripChart chart{TitleOf(outcome.row),
                         {},
                         0.0,
                         static_cast<double>(std::max(1, outcome.replayed.teach_frames))};
  chart.curves.push_back(TruthOf(outcome));
  plot::Curve place{"place", plot::kBlue, {}};
  for (const Said& said : outcome.replayed.said) place.values.emplace_back(said.teach_frame);
  chart.curves.push_back(std::move(place));
  return chart;
}

plot::StripChart TurnChart(const RecordingOutcome& outcome) {
  plot::StripChart chart{"turn asked for [rad], positive to the right", {}, -0.05, 0.05};
  plot::Curve turn{"", plot::kBlack, {}};
  for (const Said& said : outcome.replayed.said) turn.values.emplace_back(said.turn_rad);
  chart.curves.push_back(std::move(turn));
  return chart;
}

std::vector<plot::StripChart> ChartsOf(const RecordingOutcome& outcome, bool alone) {
  std::vector<plot::StripChart> charts{PlaceChart(outcome)};
  if (alone) charts.push_back(TurnChart(outcome));
  return charts;
}

void DrawHead(Drawing& drawing) {
  double x = kLeft_px;
  for (const auto& [claim, name] : kBands) {
    drawing.FillBox({x, 12.0}, {x + 22.0, 24.0}, ColorOf(claim));
    drawing.Text(name, {x + 28.0, 22.0}, 10.0, plot::kInk);
    x += 50.0 + Drawing::TextWidth(name, 10.0);
  }
}

}  // namespace

Drawing DrawRecordings(const std::vector<RecordingOutcome>& outcomes) {
  const bool alone = outcomes.size() == 1;
  const double strips = alone ? 2.0 : 1.0;
  const double height = strips * (kGap_px + kStripHeight_px) + kAxis_px;
  Drawing drawing(kWidth_px,
                  static_cast<int>(kHead_px + height * static_cast<double>(outcomes.size())),
                  plot::kWhite);
  DrawHead(drawing);
  plot::PixelBox box{kLeft_px, kHead_px, kWidth_px - kLeft_px - kRight_px, kStripHeight_px};
  for (const RecordingOutcome& outcome : outcomes) {
    const plot::ChartAxis axis = AxisOf(outcome);
    for (const plot::StripChart& chart : ChartsOf(outcome, alone)) {
      box.top += kGap_px;
      plot::DrawStrip(drawing, box, axis, chart);
      box.top += kStripHeight_px;
    }
    plot::DrawChartAxis(drawing, {box.left, box.top - kStripHeight_px, box.width, box.height},
                        axis);
    box.top += kAxis_px;
  }
  return drawing;
}

}  // namespace trailcast::trial
