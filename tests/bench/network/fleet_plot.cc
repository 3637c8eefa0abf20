// This draws what an agent costs against the size of the fleet: network.sh's `sizes` as a picture.
#include <vector>

#include "services/base/number_table.h"
#include "services/plot/plot_style.h"
#include "services/plot/strip_chart.h"
#include "tests/bench/network/network_bench.h"

namespace trailcast::bench {
namespace {

struct Panel {
  const char* column;
  const char* title;
  double scale;
  bool each;  // divided by the number of agents
};
constexpr Panel kPanels[] = {
    {"known_s", "until the server knows all agents [s]", 1.0, false},
    {"datagrams", "datagrams sent until then, an agent", 1.0, true},
    {"join_cpu_s", "the server's processor time until then, an agent [ms]", 1e3, true},
    {"server_mb", "memory of the server [MB]", 1.0, false},
    {"share", "processor that the server then uses, an agent [millionths]", 1e6, true},
};

constexpr int kWidth_px = 900;
constexpr double kLeft_px = 62.0;
constexpr double kTop_px = 40.0;
constexpr double kPanel_px = 130.0;
constexpr double kGap_px = 38.0;
constexpr double kAxis_px = 30.0;

}  // namespace

Result<void> PlotFleet(const std::filesystem::path& csv, const std::filesystem::path& picture) {
  std::vector<std::string> columns{"agents"};
  for (const Panel& panel : kPanels) columns.emplace_back(panel.column);
  const auto rows = ReadNumbers(csv, columns);
  if (!rows) return tl::unexpected(rows.error());

  plot::ChartAxis axis{.label = "agents", .x = {}, .borders = {}, .bands = {}};
  for (const NumberRow& row : *rows) axis.x.push_back(row.cells[0]);
  const double height = kTop_px + std::size(kPanels) * (kPanel_px + kGap_px) + kAxis_px;
  plot::Drawing drawing(kWidth_px, static_cast<int>(height), plot::kWhite);
  plot::PixelBox box{kLeft_px, kTop_px, kWidth_px - kLeft_px - kGap_px, kPanel_px};
  for (std::size_t i = 0; i < std::size(kPanels); ++i) {
    plot::Curve curve{"", plot::kBlue, {}};
    for (const NumberRow& row : *rows) {
      const double divisor = kPanels[i].each ? row.cells[0] : 1.0;
      curve.values.emplace_back(row.cells[i + 1] * kPanels[i].scale / divisor);
    }
    plot::DrawStrip(drawing, box, axis, {kPanels[i].title, {curve}, 0.0, 1.0});
    box.top += kPanel_px + kGap_px;
  }
  box.top -= kPanel_px + kGap_px;
  plot::DrawChartAxis(drawing, box, axis);
  return drawing.Write(picture);
}

}  // namespace trailcast::bench
