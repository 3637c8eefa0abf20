#include "services/exchange/revision_numbers.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

namespace trailcast::exchange {
namespace {

using Known = std::vector<store::KnownTeaching>;
using route::RouteInfo;

// This orders two revisions that are active.
bool CountsBefore(const RouteInfo& info, const RouteInfo& other) {
  return std::pair(other.edition, info.revision) < std::pair(info.edition, other.revision);
}

RevisionNumber NumberFor(const RouteInfo& info, const Known& known) {
  const auto of_it = std::find_if(
      known.begin(), known.end(),
      [&](const store::KnownTeaching& each) { return each.teaching == info.key.teaching; });
  if (of_it != known.end()) return std::max(of_it->revision, info.revision);
  const auto has_it = [&](const store::KnownTeaching& each) {
    return each.revision == info.revision;
  };
  const bool is_free = std::none_of(known.begin(), known.end(), has_it);
  if (info.revision.value() != 0 && is_free) return info.revision;
  RevisionNumber last;
  for (const store::KnownTeaching& each : known) last = std::max(last, each.revision);
  return RevisionNumber(last.value() + 1);
}

}  // namespace

Result<void> GiveNumbers(store::RouteStore& store, std::span<RouteInfo> infos) {
  std::map<RouteId, Known> routes;
  for (RouteInfo& info : infos) {
    const auto [at, is_first] = routes.try_emplace(info.key.route);
    if (is_first) {
      auto known = store.FindTeachings(info.key.route);
      if (!known) return tl::unexpected(known.error());
      at->second = std::move(*known);
    }
    info.revision = NumberFor(info, at->second);
    at->second.push_back({info.key.teaching, info.revision});
  }
  return {};
}

std::vector<RouteInfo> Disagreements(std::vector<RouteInfo> revisions, RevisionNumber last) {
  std::sort(revisions.begin(), revisions.end(), [](const RouteInfo& a, const RouteInfo& b) {
    return std::tie(a.taught_unix_ms, a.key.teaching) < std::tie(b.taught_unix_ms, b.key.teaching);
  });
  const std::vector<RouteInfo> before = revisions;
  std::set<RevisionNumber> taken;
  for (RouteInfo& info : revisions) {
    if (info.revision.value() == 0 || taken.insert(info.revision).second) continue;
    last = RevisionNumber(last.value() + 1);
    info.revision = last;
  }
  RouteInfo* active = nullptr;
  for (RouteInfo& info : revisions) {
    if (info.standing != route::Standing::kActive) continue;
    RouteInfo* loses = active == nullptr ? nullptr : &info;
    if (active == nullptr || CountsBefore(info, *active)) loses = std::exchange(active, &info);
    if (loses == nullptr) continue;
    loses->standing = route::Standing::kStaged;
    ++loses->edition;
  }
  std::vector<RouteInfo> changed;
  for (std::size_t i = 0; i < revisions.size(); ++i) {
    if (revisions[i] != before[i]) changed.push_back(std::move(revisions[i]));
  }
  return changed;
}

Result<std::vector<RouteInfo>> Disagreements(store::RouteStore& store, const RouteId& route) {
  auto revisions = store.FindRevisions(route);
  if (!revisions || revisions->size() < 2) {
    return revisions ? std::vector<RouteInfo>() : std::move(revisions);
  }
  const auto known = store.FindTeachings(route);
  if (!known) return tl::unexpected(known.error());
  RevisionNumber last;
  for (const store::KnownTeaching& each : *known) last = std::max(last, each.revision);
  return Disagreements(*std::move(revisions), last);
}

}  // namespace trailcast::exchange
