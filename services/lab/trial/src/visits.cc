#include "services/lab/trial/src/visits.h"

#include <algorithm>
#include <utility>

#include "services/lab/trial/refresh_taught.h"

namespace trailcast::trial {
Result<std::shared_ptr<const sim::World>> WorldAfter(const TrialSetup& setup, double share) {
  return setup.world_after ? setup.world_after(share) : setup.world;
}

Result<std::vector<TrialOutcome>> RunVisits(const TrialSetup& setup, const TrialCase& trial_case,
                                            const TrialOptions& options, int trial,
                                            const Taught& taught, const TaughtRoute& route,
                                            const TrialProgress& on_progress) {
  std::vector<TrialOutcome> outcomes;
  TaughtRoute current = route;
  const bool one_more = setup.spoiled != Spoiled::kNothing;
  const int visits = options.visits + (one_more ? 1 : 0);
  for (int visit = 1; visit <= visits; ++visit) {
    const bool spoiled = visit <= options.visits;
    const double all = visits;
    auto world = WorldAfter(setup, std::min(1.0, static_cast<double>(visit) / options.visits));
    if (!world) return tl::unexpected(world.error());
    auto followed = Follow(setup, trial_case, options, trial, taught, current,
                           {visit, std::move(*world), spoiled ? setup.spoiled : Spoiled::kNothing},
                           [&](double share) { return on_progress((visit - 1 + share) / all); });
    if (!followed) return tl::unexpected(followed.error());
    outcomes.push_back(std::move(followed->outcome));
    if (!followed->met) continue;
    TrialRow& row = outcomes.back().row;
    const auto refreshed = RefreshTaught(*followed->met, current);
    if (refreshed) {
      row.refreshed = refreshed->counts;
    } else if (refreshed.error().code == ErrorCode::kUnavailable) {
      row.reason = refreshed.error().message;
    } else {
      return tl::unexpected(refreshed.error());
    }
  }
  return outcomes;
}

}  // namespace trailcast::trial
