#include "route_server/routes/refresh_watch.h"

#include <fmt/format.h>

#include <algorithm>

#include "route_server/routes/section_reader.h"
#include "services/refresh/successor.h"

namespace trailcast::server {

void RefreshWatch::Note(const route::RouteInfo& info) {
  // An operator's decision takes precedence, as does an edition above 0: the revision has been
  // active, so somebody has rolled back.
  const bool is_new = info.state == route::RouteState::kComplete &&
                      info.standing == route::Standing::kStaged && info.edition == 0;
  const bool asks_nobody = is_new && !info.held_back();
  const bool refreshes = info.refreshes.value() > 0;
  if (!asks_nobody || !refreshes || waiting_.size() >= kMostWaiting) return;
  const auto is_it = [&](const route::RouteInfo& other) { return other.key == info.key; };
  if (comparison_ && is_it(comparison_->refreshed)) return;
  if (std::none_of(waiting_.begin(), waiting_.end(), is_it)) waiting_.push_back(info);
}

Result<void> RefreshWatch::NoteStored() {
  route::RouteQuery query;
  query.tags = {std::string(refresh::kTag)};
  query.state = route::RouteState::kComplete;
  query.standing = route::Standing::kStaged;
  do {
    const auto page = store_.QueryRoutes(query);
    if (!page) return tl::unexpected(page.error());
    for (const route::RouteInfo& info : page->routes) {
      const auto followed = FollowedOf(info.key);
      if (!followed) return tl::unexpected(followed.error());
      if (*followed && info.refreshes == (*followed)->revision) Note(info);
    }
    query.cursor = page->next;
  } while (!query.cursor.empty());
  return {};
}

Result<bool> RefreshWatch::Step() {
  auto stepped = TryStep();
  if (!stepped) comparison_.reset();
  return stepped;
}

Result<bool> RefreshWatch::TryStep() {
  if (!comparison_) {
    if (waiting_.empty()) return false;
    route::RouteInfo next = std::move(waiting_.front());
    waiting_.pop_front();
    if (auto begun = Begin(std::move(next)); !begun) return tl::unexpected(begun.error());
    return true;
  }
  auto& [refreshed, followed, next] = *comparison_;
  if (next == refreshed.segment_count) {
    Judge(std::move(refreshed), "");
    return true;
  }
  const SegmentIndex index(next++);
  const auto segment = ReadSegment(store_, refreshed.key, index);
  if (!segment) return tl::unexpected(segment.error());
  const auto before = ReadSegment(store_, followed.key, index);
  if (!before) return tl::unexpected(before.error());
  if (!refresh::IsRefreshed(*segment, *before)) {
    Judge(std::move(refreshed), fmt::format("in segment {} it is not revision {} with a few "
                                            "features or added views gone and a few new",
                                            index.value(), followed.revision.value()));
  }
  return true;
}

Result<std::optional<route::RouteInfo>> RefreshWatch::FollowedOf(const route::RouteKey& key) const {
  auto revisions = store_.FindRevisions(key.route);
  if (!revisions) return tl::unexpected(revisions.error());
  const auto followed = std::find_if(
      revisions->begin(), revisions->end(),
      [](const route::RouteInfo& info) { return info.standing == route::Standing::kActive; });
  if (followed == revisions->end()) return std::nullopt;
  return std::move(*followed);
}

Result<void> RefreshWatch::Begin(route::RouteInfo refreshed) {
  auto found = FollowedOf(refreshed.key);
  if (!found) return tl::unexpected(found.error());
  std::optional<route::RouteInfo>& followed = *found;
  const RevisionNumber visited = refreshed.refreshes;
  if (!followed || followed->revision != visited) {
    Judge(std::move(refreshed),
          fmt::format("it refreshes revision {}, which robots do not follow", visited.value()));
  } else if (followed->segment_count != refreshed.segment_count) {
    Judge(std::move(refreshed),
          fmt::format("it has other segments than revision {}", visited.value()));
  } else {
    comparison_ = Comparison{std::move(refreshed), std::move(*followed)};
  }
  return {};
}

void RefreshWatch::Judge(route::RouteInfo info, std::string why_not) {
  judged_.push_back({std::move(info), std::move(why_not)});
  comparison_.reset();
}

}  // namespace trailcast::server
