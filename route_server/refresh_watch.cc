#include "route_server/refresh_watch.h"

#include <fmt/format.h>

#include <algorithm>

#include "route_server/stretch_reader.h"
#include "services/refresh/successor.h"

namespace trailcast::server {

void RefreshWatch::Note(const route::RouteInfo& info) {
  // What an operator has done with it counts, and that one has been active before: somebody has
  // rolled back.
  const bool is_new = info.state == route::RouteState::kComplete &&
                      info.standing == route::Standing::kStaged && info.edition == 0;
  const bool asks_nobody = is_new && !info.held_back();
  if (!asks_nobody || !refresh::RevisionRefreshed(info) || waiting_.size() >= kMostWaiting) return;
  const auto is_it = [&](const route::RouteInfo& other) { return other.key == info.key; };
  if (comparison_ && is_it(comparison_->refreshed)) return;
  if (std::none_of(waiting_.begin(), waiting_.end(), is_it)) waiting_.push_back(info);
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
    Judge(std::move(refreshed),
          fmt::format("in segment {} it is not revision {} with a few features gone and a few new",
                      index.value(), followed.revision.value()));
  }
  return true;
}

Result<void> RefreshWatch::Begin(route::RouteInfo refreshed) {
  auto revisions = store_.FindRevisions(refreshed.key.route);
  if (!revisions) return tl::unexpected(revisions.error());
  const auto followed = std::find_if(
      revisions->begin(), revisions->end(),
      [](const route::RouteInfo& info) { return info.standing == route::Standing::kActive; });
  const RevisionNumber visited = *refresh::RevisionRefreshed(refreshed);
  if (followed == revisions->end() || followed->revision != visited) {
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
