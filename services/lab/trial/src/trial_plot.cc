#include "services/lab/trial/trial_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>

#include "services/lab/sim/core/plan_view.h"
#include "services/route/terrain_profile.h"

namespace trailcast::trial {
namespace {

constexpr double kMargin_m = 1.5;
constexpr int kPaleness = 150;      // of 255: how much paler the world is drawn
constexpr double kPlanCut_m = 1.6;  // above the floor
// These are for uneven, rough and very rough ground.
constexpr std::array<image::Color, 3> kBandColors{
    {{250, 225, 170}, {245, 185, 120}, {235, 140, 100}}};
constexpr std::size_t kMaxLegend = 12;  // replays or cases that are named one by one

std::uint8_t Pale(std::uint8_t value) {
  return static_cast<std::uint8_t>(value + (255 - value) * kPaleness / 255);
}

// Returns the pixels of `plan` that show `area`, white beyond the plan.
image::RgbImage Crop(const sim::PlanView& plan, const plot::PlanArea& area) {
  image::RgbImage crop;
  crop.width = std::max(1, static_cast<int>(area.size_m().x() / plan.metres_per_pixel));
  crop.height = std::max(1, static_cast<int>(area.size_m().y() / plan.metres_per_pixel));
  crop.pixels.reserve(static_cast<std::size_t>(crop.width) * static_cast<std::size_t>(crop.height) *
                      3);
  const Eigen::Vector2d corner = plan.PixelOf(area.min_m.x(), area.max_m.y());
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const int column = static_cast<int>(std::floor(corner.x())) + x;
      const int row = static_cast<int>(std::floor(corner.y())) + y;
      const bool inside =
          column >= 0 && row >= 0 && column < plan.picture.width && row < plan.picture.height;
      const std::size_t at =
          inside
              ? 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(plan.picture.width) +
                     static_cast<std::size_t>(column))
              : 0;
      for (std::size_t c = 0; c < 3; ++c) {
        crop.pixels.push_back(inside ? Pale(plan.picture.pixels[at + c]) : 255);
      }
    }
  }
  return crop;
}

// Returns the part of a path between two distances along it.
std::vector<Eigen::Vector2d> Between(const TruePath& path, double from_m, double to_m) {
  std::vector<Eigen::Vector2d> part;
  double along_m = 0.0;
  for (std::size_t i = 0; i < path.points_m().size(); ++i) {
    if (i > 0) along_m += (path.points_m()[i] - path.points_m()[i - 1]).norm();
    if (along_m >= from_m && along_m <= to_m) part.push_back(path.points_m()[i]);
  }
  return part;
}

std::string Label(const TrialRow& row) {
  return fmt::format("trial {}: {}, {:.2f} m from the end, {:.2f} m from the path in the mean",
                     row.trial, row.state, row.verdict.final_error_m,
                     row.verdict.mean_path_error_m);
}

std::string Label(const std::vector<TrialRow>& rows) {
  const TrialSummary summary = Summarize(rows);
  return fmt::format("{}: {} of {} arrived, {:.2f} m from the end, {:.2f} m from the path",
                     CaseName(rows.front()), summary.arrived, summary.trials, summary.accuracy_m,
                     summary.mean_path_error_m);
}

}  // namespace

std::vector<plot::PlottedPath> ReplayedPaths(const std::vector<TrialOutcome>& outcomes) {
  std::vector<TrialRow> rows;
  rows.reserve(outcomes.size());
  for (const TrialOutcome& outcome : outcomes) rows.push_back(outcome.row);
  std::vector<std::string> lines;  // of the legend
  const auto cases = Cases(rows);
  if (cases.size() == 1) {
    for (const TrialRow& row : rows) lines.push_back(Label(row));
  } else {
    for (const std::vector<TrialRow>& each : cases) lines.push_back(Label(each));
  }
  std::vector<bool> named(lines.size(), false);
  std::vector<plot::PlottedPath> paths;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const auto of_case =
        std::find_if(cases.begin(), cases.end(), [&](const std::vector<TrialRow>& each) {
          return CaseName(each.front()) == CaseName(rows[i]);
        });
    const std::size_t line =
        cases.size() == 1 ? i : static_cast<std::size_t>(of_case - cases.begin());
    const bool in_legend = line < kMaxLegend && !named[line];
    named[line] = true;
    paths.push_back({in_legend ? lines[line] : "", plot::PathColor(line + 1),
                     outcomes[i].replayed.points_m(), false, !rows[i].arrived});
  }
  return paths;
}

std::vector<plot::PlottedPath> RoughSections(const TrialOutcome& outcome) {
  std::vector<plot::PlottedPath> bands;
  std::set<route::Roughness> named;
  if (outcome.ground.empty() || outcome.ground.back().end <= 0.0) return bands;
  const double share = outcome.taught.length_m() / outcome.ground.back().end;
  for (const route::TerrainSection& section : outcome.ground) {
    const auto roughness = route::RoughnessOf(section.terrain);
    if (!roughness || *roughness == route::Roughness::kSmooth) continue;
    const bool first = named.insert(*roughness).second;
    bands.push_back({first ? fmt::format("{} ground", route::NameOf(*roughness)) : "",
                     kBandColors[static_cast<std::size_t>(*roughness) - 1],
                     Between(outcome.taught, share * section.begin, share * section.end), false,
                     false, true});
  }
  return bands;
}

plot::Backdrop WorldBackdrop(const sim::World& world, const std::vector<plot::PlottedPath>& paths) {
  const plot::PlanArea area = plot::AreaAround(paths, kMargin_m);
  sim::PlanOptions options;
  const bool somewhere = !paths.empty() && !paths.front().points_m.empty();
  const Eigen::Vector2d start_m =
      somewhere ? paths.front().points_m.front() : Eigen::Vector2d(Eigen::Vector2d::Zero());
  options.cut_z_m = world.FloorHeight(start_m.x(), start_m.y()).value_or(0.0) + kPlanCut_m;
  return {Crop(sim::RenderPlan(world, options), area), area};
}

Result<void> WriteTrialPlot(const TrialSetup& setup, const std::vector<TrialOutcome>& outcomes,
                            const std::filesystem::path& file) {
  plot::Plan plan;
  const TrialCase& first = setup.cases.front();
  plan.title = setup.scenario + ": ";
  plan.title +=
      setup.cases.size() == 1
          ? fmt::format("method {}, taught by {}, followed by {}", agent::ToString(first.method),
                        first.scout_camera.name, first.follower_camera.name)
          : fmt::format("{} cases", setup.cases.size());
  plan.paths.push_back({"taught (first trial)", plot::PathColor(0),
                        outcomes.front().taught.points_m(), true, false});
  for (plot::PlottedPath& path : ReplayedPaths(outcomes)) plan.paths.push_back(std::move(path));
  for (plot::PlottedPath& band : RoughSections(outcomes.front())) {
    plan.paths.push_back(std::move(band));
  }
  plan.backdrop = WorldBackdrop(*setup.world, plan.paths);
  return plot::DrawPlan(plan).Write(file);
}

}  // namespace trailcast::trial
