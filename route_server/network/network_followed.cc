// This part of NetworkRegistry knows how well robots follow.
#include <algorithm>
#include <utility>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"

namespace trailcast::server {

Result<void> NetworkRegistry::KeepFollowed(std::int64_t now_unix_ms) {
  // NoteChange() is left out, because robots under way keep their path.
  auto poor = followed_.Poorly(now_unix_ms);
  if (poor != poor_) network_.reset();
  poor_ = std::move(poor);
  const auto unsaved = followed_.Unsaved();
  if (unsaved.empty()) return {};
  if (auto put = store_->Put(unsaved); !put) return put;
  followed_.NoteSaved();
  return {};
}

std::optional<double> NetworkRegistry::LengthOf(const route::RouteKey& key) const {
  const auto info = routes_.FindRoute(key);
  if (!info || !*info || (*info)->state != route::RouteState::kComplete) return std::nullopt;
  return (*info)->length_m > 0.0 ? std::optional((*info)->length_m) : std::nullopt;
}

std::vector<network::Condition> NetworkRegistry::CostsOfPoor() const {
  std::vector<network::Condition> costs;
  for (const FollowedLately::Poor& each : poor_) {
    costs.push_back(
        {.route = IdOf(each.key), .from_m = each.from_m, .to_m = each.to_m, .cost = each.cost});
  }
  return costs;
}

std::vector<std::string> NetworkRegistry::PoorLines() const {
  std::vector<std::string> lines;
  for (const FollowedLately::Poor& each : poor_) {
    const auto known = known_.find(each.key.route);
    if (known == known_.end() || !known->second.followed) continue;
    const route::RouteInfo& followed = *known->second.followed;
    if (followed.key != each.key) continue;
    lines.push_back(
        network::ToText(network::LostSection{.route = known->second.called,
                                             .from_m = each.from_m,
                                             .to_m = std::min(each.to_m, followed.length_m),
                                             .passed = each.passed,
                                             .lost = each.lost,
                                             .cost = each.cost}));
  }
  return lines;
}

}  // namespace trailcast::server
