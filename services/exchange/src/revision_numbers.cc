#include "services/exchange/revision_numbers.h"

#include <algorithm>
#include <map>

namespace trailcast::exchange {
namespace {

using Known = std::vector<store::KnownTeaching>;

RevisionNumber NumberFor(const route::RouteInfo& info, const Known& known) {
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

Result<void> GiveNumbers(store::RouteStore& store, std::vector<route::RouteInfo>& infos) {
  std::map<RouteId, Known> routes;
  for (route::RouteInfo& info : infos) {
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

}  // namespace trailcast::exchange
