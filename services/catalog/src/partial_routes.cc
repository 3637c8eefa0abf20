#include "services/catalog/partial_routes.h"

#include <algorithm>

namespace trailcast::catalog {
namespace {

constexpr std::uint32_t kPartialPage = 50;
constexpr std::chrono::hours kTellAgain{1};

}  // namespace

Result<std::vector<route::RouteKey>> PartialRoutes::Look() {
  const auto page = store_.QueryRoutes(
      {.order = route::RouteOrder::kName, .page_size = kPartialPage, .cursor = cursor_});
  if (!page) return tl::unexpected(page.error());
  std::vector<route::RouteKey> partial;
  for (const route::RouteInfo& info : page->routes) {
    const auto is_partial = LookAt(info);
    if (!is_partial) return tl::unexpected(is_partial.error());
    if (*is_partial) partial.push_back(info.key);
  }
  cursor_ = page->next;
  if (cursor_.empty()) ForgetUnseen();
  return partial;
}

Result<bool> PartialRoutes::LookAt(const route::RouteInfo& info) {
  const auto missing = store::FindLacking(store_, info);
  if (!missing) return tl::unexpected(missing.error());
  const auto known = partial_.find(info.key);
  if (missing->empty() && known == partial_.end()) return false;
  Partial& partial = partial_[info.key];
  partial.info = info;
  partial.missing = {missing->begin(), missing->end()};
  partial.seen_in_round = round_;
  // Another server that shares the store may have repaired it.
  std::erase_if(partial.damaged, [&](SegmentIndex segment) {
    return store_.ReadSegment(info.key, segment).has_value();
  });
  if (!partial.missing.empty() || !partial.damaged.empty()) return true;
  partial_.erase(info.key);
  return false;
}

// These routes have left the store.
void PartialRoutes::ForgetUnseen() {
  std::erase_if(partial_, [&](const auto& each) { return each.second.seen_in_round < round_; });
  ++round_;
}

void PartialRoutes::NoteDamaged(const route::RouteKey& key, SegmentIndex segment) {
  const auto info = store_.FindRoute(key);
  if (!info || !*info || (*info)->state != route::RouteState::kComplete) return;
  Partial& partial = partial_[key];
  partial.info = **info;
  partial.damaged.insert(segment);
  partial.seen_in_round = round_;
}

void PartialRoutes::NoteStored(const route::RouteKey& key, SegmentIndex segment) {
  const auto found = partial_.find(key);
  if (found == partial_.end()) return;
  found->second.missing.erase(segment);
  found->second.damaged.erase(segment);
  if (found->second.missing.empty() && found->second.damaged.empty()) partial_.erase(found);
}

std::vector<store::LackingRoute> PartialRoutes::TakeUntold(Time now) {
  std::vector<store::LackingRoute> untold;
  for (auto& [key, partial] : partial_) {
    if (partial.told && now < *partial.told + kTellAgain) continue;
    partial.told = now;
    std::set<SegmentIndex> lacking = partial.missing;
    lacking.insert(partial.damaged.begin(), partial.damaged.end());
    untold.push_back({partial.info, {lacking.begin(), lacking.end()}});
  }
  return untold;
}

std::size_t PartialRoutes::segments() const {
  std::size_t count = 0;
  for (const auto& [key, partial] : partial_) count += LackingOf(key);
  return count;
}

std::size_t PartialRoutes::LackingOf(const route::RouteKey& key) const {
  const auto found = partial_.find(key);
  if (found == partial_.end()) return 0;
  return found->second.missing.size() + found->second.damaged.size();
}

}  // namespace trailcast::catalog
