#pragma once

#include <filesystem>
#include <vector>

#include "services/base/result.h"
#include "services/lab/sim/core/world.h"
#include "services/lab/trial/trial.h"
#include "services/plot/plan_plot.h"

namespace trailcast::trial {

// Returns the driven paths in the order of the outcomes. With one case, each replay has its own
// colour; with several, each case has a colour and a line in the legend.
[[nodiscard]] std::vector<plot::PlottedPath> ReplayedPaths(
    const std::vector<TrialOutcome>& outcomes);

// Returns where the ground felt rough, along the taught path.
[[nodiscard]] std::vector<plot::PlottedPath> RoughSections(const TrialOutcome& outcome);

// Returns the part of the world around the paths, seen from above and made pale.
[[nodiscard]] plot::Backdrop WorldBackdrop(const sim::World& world,
                                           const std::vector<plot::PlottedPath>& paths);

// Writes the taught and the replayed paths of a batch over the world's plan, as PNG.
[[nodiscard]] Result<void> WriteTrialPlot(const TrialSetup& setup,
                                          const std::vector<TrialOutcome>& outcomes,
                                          const std::filesystem::path& file);

}  // namespace trailcast::trial
