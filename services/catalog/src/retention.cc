#include "services/catalog/retention.h"

#include <set>

namespace trailcast::catalog {
namespace {

using route::RouteInfo;

constexpr std::uint32_t kRetentionPage = 100;

}  // namespace

Result<std::vector<RouteInfo>> Retention::Next(const AgesOf& ages_of) {
  const auto page = store_.QueryRoutes(
      {.order = route::RouteOrder::kName, .page_size = kRetentionPage, .cursor = cursor_});
  if (!page) {
    cursor_.clear();  // from the beginning
    return tl::unexpected(page.error());
  }
  cursor_ = page->next;
  std::set<RouteId> seen;
  std::vector<std::vector<RouteInfo>> routes;
  std::vector<Grown> grown;
  for (const RouteInfo& info : page->routes) {
    if (!seen.insert(info.key.route).second) continue;
    auto revisions = store_.FindRevisions(info.key.route);
    if (!revisions) return tl::unexpected(revisions.error());
    routes.push_back(*std::move(revisions));
    if (policy_.keep_for.count() == 0) continue;
    const auto known = store_.FindTeachings(info.key.route);
    if (!known) return tl::unexpected(known.error());
    for (const store::KnownTeaching& each : *known) {
      grown.push_back({{info.key.route, each.teaching}, each.grown_unix_ms});
    }
  }
  const auto ages = ages_of(grown);
  if (!ages) return tl::unexpected(ages.error());
  Ages age_of;
  for (std::size_t i = 0; i < grown.size(); ++i) age_of[grown[i].first] = ages->at(i);
  std::vector<RouteInfo> outdated;
  for (const std::vector<RouteInfo>& revisions : routes) {
    for (RouteInfo& each : Outdated(revisions, age_of)) outdated.push_back(std::move(each));
  }
  return outdated;
}

std::vector<RouteInfo> Retention::Outdated(const std::vector<RouteInfo>& revisions,
                                           const Ages& ages) const {
  std::vector<RouteInfo> outdated;
  std::uint32_t newer = 0;  // counts complete ones
  for (auto info = revisions.rbegin(); info != revisions.rend(); ++info) {
    if (info->standing == route::Standing::kActive) continue;
    const bool complete = info->state == route::RouteState::kComplete;
    const bool too_many = policy_.keep_revisions > 0 && complete && newer >= policy_.keep_revisions;
    const auto age = ages.find(info->key);
    const bool too_old =
        policy_.keep_for.count() > 0 && age != ages.end() && age->second > policy_.keep_for;
    if (complete) ++newer;
    if (!too_many && !too_old) continue;
    outdated.push_back(*info);
    outdated.back().standing = route::Standing::kDeleted;
    ++outdated.back().edition;
  }
  return outdated;
}

}  // namespace trailcast::catalog
