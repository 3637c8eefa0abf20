#pragma once

#include <filesystem>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/trial/trial.h"
#include "services/plot/plan_plot.h"

namespace trailcast::trial {

// What was driven, in the order of the outcomes: of one case, each replay in its own colour; of
// several, a colour and a line of the legend for each of them.
[[nodiscard]] std::vector<plot::PlottedPath> ReplayedPaths(
    const std::vector<TrialOutcome>& outcomes);

// Where the ground was felt to be rough, along the path as it was taught.
[[nodiscard]] std::vector<plot::PlottedPath> RoughStretches(const TrialOutcome& outcome);

// The part of the world that lies around the paths, seen from above and made pale.
[[nodiscard]] plot::Backdrop WorldBackdrop(const sim::World& world,
                                           const std::vector<plot::PlottedPath>& paths);

// Taught and replayed paths of a batch over the world's plan, as PNG.
[[nodiscard]] Result<void> WriteTrialPlot(const TrialSetup& setup,
                                          const std::vector<TrialOutcome>& outcomes,
                                          const std::filesystem::path& file);

}  // namespace trailcast::trial
