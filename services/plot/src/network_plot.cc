#include "services/plot/network_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "services/plot/plot_style.h"

namespace trailcast::plot {
namespace {

using image::Color;
using image::PixelPoint;
using Picture = NetworkPicture;

constexpr double kNetworkTextHeight_px = 11.0;
constexpr double kRow_px = 74.0;
constexpr double kNetworkTop_px = 56.0;
constexpr double kNetworkLeft_px = 30.0;
constexpr double kNetworkRight_px = 30.0;
constexpr double kWide_px = 960.0;
constexpr double kBow_px = 20.0;
constexpr double kWall_px = 7.0;
constexpr double kBackwards_px = 14.0;
constexpr double kTick_px = 5.0;
constexpr double kTicks_px = 7.0;
constexpr double kArrow_px = 8.0;
constexpr double kScale_px = 46.0;  // below the last row
constexpr Color kQuiet{120, 120, 120};

class Map {
 public:
  explicit Map(const Picture& network) : network_(network), starts_m_(RowStarts(network)) {
    for (std::size_t i = 0; i < network.routes.size(); ++i) {
      end_m_ = std::max(end_m_, starts_m_[i] + network.routes[i].length_m);
      const double text_px = Drawing::TextWidth(LabelOf(i), kNetworkTextHeight_px);
      longest_text_px_ = std::max(longest_text_px_, text_px);
    }
    px_per_m_ = kWide_px / std::max(end_m_, 1e-3);
  }

  [[nodiscard]] Drawing Draw() const {
    const double wide_px =
        kNetworkLeft_px + std::max(kWide_px, longest_text_px_) + kNetworkRight_px;
    const double high_px = kNetworkTop_px +
                           static_cast<double>(network_.routes.size() - 1) * kRow_px +
                           2.0 * kScale_px;
    Drawing drawing(static_cast<int>(wide_px), static_cast<int>(high_px), kWhite);
    for (const Picture::Junction& junction : network_.junctions) DrawJunction(drawing, junction);
    for (std::size_t i = 0; i < network_.routes.size(); ++i) DrawRoute(drawing, i);
    for (const Picture::Name& name : network_.names) DrawName(drawing, name);
    DrawScale(drawing, high_px - 22.0);
    return drawing;
  }

 private:
  [[nodiscard]] std::string LabelOf(std::size_t route) const {
    return fmt::format("{}, {:.1f} m", network_.routes[route].name,
                       network_.routes[route].length_m);
  }

  [[nodiscard]] PixelPoint At(std::size_t route, double along_m) const {
    return {kNetworkLeft_px + (starts_m_[route] + along_m) * px_per_m_,
            kNetworkTop_px + static_cast<double>(route) * kRow_px};
  }
  [[nodiscard]] PixelPoint At(const Picture::Place& place) const {
    return At(place.route, place.along_m);
  }

  void DrawRoute(Drawing& drawing, std::size_t number) const {
    const Picture::Route& route = network_.routes[number];
    const PixelPoint begin = At(number, 0.0);
    const PixelPoint end = At(number, route.length_m);
    drawing.Line({begin, end}, kBlue, 4.0);
    for (const Picture::Marked& marked : route.marked) {
      const PixelPoint from = At(number, std::min(marked.from_m, route.length_m));
      const PixelPoint to = At(number, std::min(marked.to_m, route.length_m));
      if (marked.part == Picture::Part::kNarrow) {
        DrawWalls(drawing, from, to);
        continue;
      }
      if (marked.part == Picture::Part::kLost) {
        DrawTicks(drawing, from, to);
        continue;
      }
      if (marked.part == Picture::Part::kBacked) {
        DrawBacked(drawing, from, to);
        continue;
      }
      const bool closed = marked.part == Picture::Part::kClosed;
      drawing.Line({from, to}, closed ? kOrange : kGreen, closed ? 10.0 : 6.0);
      if (!closed) continue;
      drawing.Cross({0.5 * (from.x + to.x), from.y}, 7.0, kInk, 2.0);
    }
    drawing.Disc(begin, 4.0, kBlue);
    DrawHead(drawing, {end.x - 1.0, end.y}, end, kBlue);
    Write(drawing, LabelOf(number), {begin.x + 6.0, begin.y - 12.0});
  }

  // Draws walls on either side of a mutex zone.
  static void DrawWalls(Drawing& drawing, PixelPoint from, PixelPoint to) {
    for (const double side : {-kWall_px, kWall_px}) {
      drawing.Line({{from.x, from.y + side}, {to.x, to.y + side}}, kInk, 2.0);
    }
  }

  // Draws an arrow backwards, below the line and its walls, where robots may reverse as well.
  static void DrawBacked(Drawing& drawing, PixelPoint from, PixelPoint to) {
    const PixelPoint begin{to.x, to.y + kBackwards_px};
    const PixelPoint end{from.x, from.y + kBackwards_px};
    drawing.Line({begin, end}, kBlue, 2.0);
    DrawHead(drawing, begin, end, kBlue);
  }

  // Draws ticks across the line where robots lose their path.
  static void DrawTicks(Drawing& drawing, PixelPoint from, PixelPoint to) {
    for (double x = from.x; x <= to.x; x += kTicks_px) {
      drawing.Line({{x, from.y - kTick_px}, {x, from.y + kTick_px}}, kOrange, 2.0);
    }
  }

  void DrawJunction(Drawing& drawing, const Picture::Junction& junction) const {
    const PixelPoint from = At(junction.from);
    const PixelPoint to = At(junction.to);
    std::vector<PixelPoint> way{from, to};
    if (junction.from.route == junction.to.route) {
      way = {from, {from.x, from.y + kBow_px}, {to.x, to.y + kBow_px}, to};
    }
    drawing.Line(way, kQuiet, 2.0, !junction.used);
    DrawHead(drawing, way[way.size() - 2], to, kQuiet);
    if (junction.both) DrawHead(drawing, way[1], from, kQuiet);
  }

  static void DrawHead(Drawing& drawing, PixelPoint from, PixelPoint to, Color color) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (length <= 0.0) return;
    const double x = (to.x - from.x) / length * kArrow_px;
    const double y = (to.y - from.y) / length * kArrow_px;
    drawing.FillPolygon(
        {to, {to.x - x - 0.6 * y, to.y - y + 0.6 * x}, {to.x - x + 0.6 * y, to.y - y - 0.6 * x}},
        color);
  }

  // Writes over any line that passes there.
  static void Write(Drawing& drawing, const std::string& text, PixelPoint at) {
    const double wide_px = Drawing::TextWidth(text, kNetworkTextHeight_px);
    drawing.FillBox({at.x - 2.0, at.y - kNetworkTextHeight_px - 2.0},
                    {at.x + wide_px + 2.0, at.y + 3.0}, kWhite);
    drawing.Text(text, at, kNetworkTextHeight_px, kInk);
  }

  void DrawName(Drawing& drawing, const Picture::Name& name) const {
    const PixelPoint at = At(name.place);
    const double text_px = Drawing::TextWidth(name.name, kNetworkTextHeight_px);
    const double x =
        std::min(at.x + 6.0, kNetworkLeft_px + kWide_px + kNetworkRight_px - text_px - 2.0);
    drawing.Disc(at, 6.0, kInk);
    drawing.Disc(at, 3.5, kWhite);
    Write(drawing, name.name, {x, at.y + 20.0});
  }

  void DrawScale(Drawing& drawing, double y) const {
    const double step_m = TickStep(end_m_, 8.0);
    const double to = kNetworkLeft_px + step_m * px_per_m_;
    drawing.Line({{kNetworkLeft_px, y}, {to, y}}, kInk, 2.0);
    for (const double x : {kNetworkLeft_px, to})
      drawing.Line({{x, y - 4.0}, {x, y + 4.0}}, kInk, 2.0);
    drawing.Text(fmt::format("{:g} m", step_m), {to + 8.0, y + 4.0}, kNetworkTextHeight_px, kInk);
  }

  const Picture& network_;
  std::vector<double> starts_m_;
  double end_m_ = 0.0;
  double longest_text_px_ = 0.0;
  double px_per_m_ = 1.0;
};

}  // namespace

std::vector<double> RowStarts(const NetworkPicture& network) {
  std::vector<double> starts_m(network.routes.size(), 0.0);
  for (std::size_t row = 0; row < starts_m.size(); ++row) {
    std::optional<double> start_m;
    for (const Picture::Junction& junction : network.junctions) {
      const bool leads_up = junction.from.route == row;
      const Picture::Place& here = leads_up ? junction.from : junction.to;
      const Picture::Place& above = leads_up ? junction.to : junction.from;
      if (here.route != row || above.route >= row) continue;
      start_m = starts_m[above.route] + above.along_m - here.along_m;
      break;
    }
    starts_m[row] = start_m.value_or(0.0);
  }
  if (starts_m.empty()) return starts_m;
  const double least_m = *std::min_element(starts_m.begin(), starts_m.end());
  for (double& start_m : starts_m) start_m -= least_m;
  return starts_m;
}

Drawing DrawNetwork(const NetworkPicture& network) { return Map(network).Draw(); }

}  // namespace trailcast::plot
