#include "services/tool/diff_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "services/fleet/routes/route_summary.h"
#include "services/plot/plot_style.h"
#include "services/plot/strip_chart.h"
#include "services/program/json.h"
#include "services/route/route_ref.h"

namespace trailcast::tool {
namespace {

using junctions::Part;
using program::Json;
using program::Rounded;

constexpr double kWorthSaying_m = 0.1;

const char* UnitOf(bool metric) { return metric ? "m" : "s"; }

std::string AsideText(const std::optional<double>& aside_m) {
  if (!aside_m) return "-";
  const double aside = std::abs(*aside_m);
  if (aside < kWorthSaying_m) return "0";
  return fmt::format("{:.1f} m {}", aside, *aside_m > 0.0 ? "left" : "right");
}

double LengthOf(const std::vector<Part>& parts) {
  double length = 0.0;
  for (const Part& part : parts) length += part.end - part.begin;
  return length;
}

std::string Percent(const Part& part) { return fmt::format("{:.0f} %", 100.0 * part.share()); }

Json RouteJson(const route::RouteInfo& info) {
  return {{"name", info.name},
          {"route", info.key.route.value()},
          {"revision", info.revision.value()},
          {"length_m", Rounded(info.length_m, 100.0)},
          {"bytes", info.bytes}};
}

Json PartsJson(const std::vector<Part>& parts) {
  Json list = Json::array();
  for (const Part& part : parts) {
    list.push_back({{"begin", Rounded(part.begin, 100.0)},
                    {"end", Rounded(part.end, 100.0)},
                    {"begin_b", Rounded(part.begin_b, 100.0)},
                    {"end_b", Rounded(part.end_b, 100.0)},
                    {"features", part.features},
                    {"stayed", part.stayed},
                    {"went", part.went()},
                    {"came", part.came},
                    {"aside_m", program::RoundedOrNull(part.aside_m, 100.0)}});
  }
  return list;
}

bool GoesOn(const std::vector<Part>& parts, std::size_t i) {
  constexpr double kNothing = 1e-6;
  return i + 1 < parts.size() && parts[i + 1].begin <= parts[i].end + kNothing;
}

// Each part has a point at both ends, so that its value is drawn all along it, and one more before
// a gap.
plot::ChartAxis AxisOf(const std::string& label, const std::vector<Part>& parts) {
  constexpr image::Color kDiffers{255, 236, 170};
  plot::ChartAxis axis{.label = label, .x = {}, .borders = {}, .bands = {}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    axis.x.insert(axis.x.end(), {parts[i].begin, parts[i].end});
    if (!GoesOn(parts, i)) axis.x.push_back(parts[i].end);
  }
  for (const Part& part : junctions::Differing(parts)) {
    axis.bands.push_back({part.begin, part.end, kDiffers});
  }
  return axis;
}

using Value = std::function<std::optional<double>(const Part&)>;
plot::Curve CurveOf(const std::vector<Part>& parts, const std::string& label, image::Color color,
                    const Value& value) {
  plot::Curve curve{.label = label, .color = color, .values = {}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    curve.values.insert(curve.values.end(), {value(parts[i]), value(parts[i])});
    if (!GoesOn(parts, i)) curve.values.emplace_back();
  }
  return curve;
}

std::vector<plot::StripChart> ChartsOf(const junctions::Comparison& found) {
  const auto density = [](auto count) -> Value {
    return [count](const Part& part) -> std::optional<double> {
      const double length = part.end - part.begin;
      if (length <= 0.0) return std::nullopt;
      return std::invoke(count, part) / length;
    };
  };
  const std::string title = std::string("features a ") + (found.metric ? "metre" : "second");
  std::vector<plot::StripChart> charts{
      {.title = title,
       .curves = {CurveOf(found.parts, "stayed", plot::kBlue, density(&Part::stayed)),
                  CurveOf(found.parts, "went", plot::kOrange, density(&Part::went)),
                  CurveOf(found.parts, "came", plot::kGreen, density(&Part::came))}}};
  const auto aside = [](const Part& part) { return part.aside_m; };
  if (std::any_of(found.parts.begin(), found.parts.end(), aside)) {
    charts.push_back({.title = "path moved to the left [m]",
                      .curves = {CurveOf(found.parts, "", plot::kInk, aside)},
                      .least_y = -0.5,
                      .largest_y = 0.5});
  }
  return charts;
}

// Two scouts may have given the same name to two routes.
std::string CalledIn(const RouteDiff& diff, const route::RouteInfo& info) {
  if (diff.a.name != diff.b.name || diff.a.key.route == diff.b.key.route) {
    return fmt::format("{}@{}", info.name, info.revision.value());
  }
  const route::RouteInfo both[] = {diff.a, diff.b};
  return route::ShortIds(both).Of(info);
}

// Tells how the second route relates to the first.
std::string HowText(const RouteDiff& diff) {
  const std::string a = CalledIn(diff, diff.a);
  const std::string b = CalledIn(diff, diff.b);
  const junctions::Comparison& found = diff.found;
  if (found.refreshed) return fmt::format("{} has the path of {}", b, a);
  if (found.parts.empty()) return fmt::format("{} does not go the way of {}", b, a);
  return fmt::format("{} goes the way of {} for {:.1f} of its {:.1f} {}", b, a,
                     LengthOf(found.parts), found.length, UnitOf(found.metric));
}

std::string CountText(const RouteDiff& diff) {
  const auto size = [](const route::RouteInfo& info) {
    return fmt::format("{}, {:.0f} kB", fleet::LengthText(info),
                       static_cast<double>(info.bytes) / 1000.0);
  };
  std::string text;
  if (!diff.found.parts.empty()) {
    const Part all = junctions::Together(diff.found.parts);
    text = fmt::format("{} of {} features stayed, {} went, {} came; ", Percent(all), all.features,
                       all.went(), all.came);
  }
  return text + size(diff.a) + " and " + size(diff.b);
}

std::string SectionText(double begin, double end) {
  return fmt::format("{:.1f}..{:.1f}", begin, end);
}

}  // namespace

std::string DiffText(const RouteDiff& diff) {
  const junctions::Comparison& found = diff.found;
  const std::vector<Part> differing = junctions::Differing(found.parts);
  std::string text;
  if (!differing.empty()) {
    text = fmt::format("{:>18}  {:>18}  {:>6}  {:>5}  {:>5}  {}\n",
                       CalledIn(diff, diff.a) + " [" + UnitOf(found.metric) + "]",
                       CalledIn(diff, diff.b) + " [" + UnitOf(found.metric_b) + "]", "stayed",
                       "went", "came", "path moved");
  }
  for (const Part& part : differing) {
    text +=
        fmt::format("{:>18}  {:>18}  {:>6}  {:>5}  {:>5}  {}\n", SectionText(part.begin, part.end),
                    SectionText(part.begin_b, part.end_b), Percent(part), part.went(), part.came,
                    found.refreshed ? "0" : AsideText(part.aside_m));
  }
  if (differing.empty() && !found.parts.empty()) {
    text = "no section differs more than the others\n";
  }
  return text + HowText(diff) + ": " + CountText(diff) + "\n";
}

Json DiffJson(const RouteDiff& diff) {
  const junctions::Comparison& found = diff.found;
  return {{"a", RouteJson(diff.a)},
          {"b", RouteJson(diff.b)},
          {"refreshed", found.refreshed},
          {"unit_a", UnitOf(found.metric)},
          {"unit_b", UnitOf(found.metric_b)},
          {"differing", PartsJson(junctions::Differing(found.parts))},
          {"parts", PartsJson(found.parts)}};
}

Result<plot::Drawing> DrawDiff(const RouteDiff& diff) {
  constexpr int kWidth_px = 1100;
  constexpr double kLeft_px = 62.0;
  constexpr double kRight_px = 22.0;
  constexpr double kHead_px = 54.0;
  constexpr double kGap_px = 38.0;  // This leaves room for a title and a legend.
  constexpr double kStripHeight_px = 150.0;
  constexpr double kAxis_px = 48.0;
  constexpr double kTextHeight_px = 11.0;
  const junctions::Comparison& found = diff.found;
  if (found.parts.empty()) return Fail(ErrorCode::kInvalidArgument, "{}", HowText(diff));
  const std::vector<plot::StripChart> charts = ChartsOf(found);
  const double strips_px = static_cast<double>(charts.size()) * (kGap_px + kStripHeight_px);
  plot::Drawing drawing(kWidth_px, static_cast<int>(kHead_px + strips_px + kAxis_px), plot::kWhite);
  drawing.Text(HowText(diff), {kLeft_px, 24.0}, kTextHeight_px, plot::kInk);
  drawing.Text(CountText(diff), {kLeft_px, 44.0}, kTextHeight_px, plot::kInk);
  const plot::ChartAxis axis = AxisOf(
      fmt::format("along {} [{}]", CalledIn(diff, diff.a), UnitOf(found.metric)), found.parts);
  plot::PixelBox box{kLeft_px, kHead_px, kWidth_px - kLeft_px - kRight_px, kStripHeight_px};
  for (const plot::StripChart& chart : charts) {
    box.top += kGap_px;
    plot::DrawStrip(drawing, box, axis, chart);
    if (&chart == &charts.back()) plot::DrawChartAxis(drawing, box, axis);
    box.top = box.bottom();
  }
  return drawing;
}

}  // namespace trailcast::tool
