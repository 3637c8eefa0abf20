#include "services/trial/src/visits.h"

#include <algorithm>
#include <utility>

#include "services/refresh/refresh.h"
#include "services/route/digest.h"

namespace trailcast::trial {
namespace {

// What is made of the route for the next visit; a visit that is not believed leaves it as it is,
// and the row says why.
Result<void> RefreshRoute(const refresh::Visit& met, TaughtRoute& route, TrialRow& row) {
  std::vector<route::Segment> segments;
  segments.reserve(route.pieces.size());
  for (const route::SegmentPiece& piece : route.pieces) {
    auto segment = route::Open(piece);
    if (!segment) return tl::unexpected(segment.error());
    segments.push_back(std::move(*segment));
  }
  const auto refreshed = refresh::Refresh(segments, met);
  if (!refreshed) {
    row.reason = refreshed.error().message;
    return {};
  }
  row.refreshed = refreshed->counts;
  route.info.bytes = 0;
  for (std::size_t i = 0; i < route.pieces.size(); ++i) {
    route.pieces[i] = route::MakePiece(route.info.key, refreshed->segments[i]);
    route.info.bytes += route.pieces[i].bytes.size();
  }
  return {};
}

}  // namespace

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
    if (auto done = RefreshRoute(*followed->met, current, outcomes.back().row); !done) {
      return tl::unexpected(done.error());
    }
  }
  return outcomes;
}

}  // namespace trailcast::trial
