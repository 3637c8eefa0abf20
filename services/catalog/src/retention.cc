#include "services/catalog/retention.h"

#include <map>
#include <set>

#include "services/base/unix_time.h"

namespace trailcast::catalog {
namespace {

using route::RouteInfo;

constexpr std::uint32_t kRetentionPage = 100;

}  // namespace

Result<std::vector<RouteInfo>> Retention::Next(std::chrono::system_clock::time_point now) {
  const std::int64_t now_unix_ms = UnixMs(now);
  const auto page = store_.QueryRoutes(
      {.order = route::RouteOrder::kName, .page_size = kRetentionPage, .cursor = cursor_});
  if (!page) {
    cursor_.clear();  // from the beginning
    return tl::unexpected(page.error());
  }
  cursor_ = page->next;
  std::set<RouteId> seen;
  std::vector<RouteInfo> outdated;
  for (const RouteInfo& info : page->routes) {
    if (!seen.insert(info.key.route).second) continue;
    const auto revisions = store_.FindRevisions(info.key.route);
    if (!revisions) return tl::unexpected(revisions.error());
    const auto known = store_.FindTeachings(info.key.route);
    if (!known) return tl::unexpected(known.error());
    std::map<TeachingId, std::int64_t> grown_unix_ms;
    for (const store::KnownTeaching& each : *known) {
      grown_unix_ms[each.teaching] = each.grown_unix_ms;
    }
    for (RouteInfo& each : Outdated(*revisions, grown_unix_ms, now_unix_ms)) {
      outdated.push_back(std::move(each));
    }
  }
  return outdated;
}

std::vector<RouteInfo> Retention::Outdated(const std::vector<RouteInfo>& revisions,
                                           const std::map<TeachingId, std::int64_t>& grown_unix_ms,
                                           std::int64_t now_unix_ms) const {
  const std::int64_t keep_ms = std::chrono::milliseconds(policy_.keep_for).count();
  std::vector<RouteInfo> outdated;
  std::uint32_t newer = 0;  // complete ones
  for (auto info = revisions.rbegin(); info != revisions.rend(); ++info) {
    if (info->standing == route::Standing::kActive) continue;
    const bool complete = info->state == route::RouteState::kComplete;
    const bool too_many = policy_.keep_revisions > 0 && complete && newer >= policy_.keep_revisions;
    const auto grown = grown_unix_ms.find(info->key.teaching);
    const bool too_old =
        keep_ms > 0 && grown != grown_unix_ms.end() && grown->second < now_unix_ms - keep_ms;
    if (complete) ++newer;
    if (!too_many && !too_old) continue;
    outdated.push_back(*info);
    outdated.back().standing = route::Standing::kDeleted;
    ++outdated.back().edition;
  }
  return outdated;
}

}  // namespace trailcast::catalog
