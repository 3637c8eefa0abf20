#include "agent/duty/refreshing.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "agent/link/outbox.h"
#include "services/base/unix_time.h"
#include "services/exchange/revision_numbers.h"
#include "services/refresh/refresh.h"
#include "services/refresh/successor.h"
#include "services/route/digest.h"
#include "services/route/labels.h"

namespace trailcast::agent {
namespace {

// If a smaller share of the judged features was missed, no new revision is worth it.
constexpr double kFewMissed = 0.05;

Result<std::vector<route::Segment>> ReadAll(const route::RouteInfo& route,
                                            store::RouteStore& store) {
  std::vector<route::Segment> segments;
  segments.reserve(route.segment_count);
  for (std::uint32_t i = 0; i < route.segment_count; ++i) {
    const auto piece = store.ReadSegment(route.key, SegmentIndex(i));
    if (!piece) return tl::unexpected(piece.error());
    auto segment = route::Open(*piece);
    if (!segment) return tl::unexpected(segment.error());
    segments.push_back(std::move(*segment));
  }
  return segments;
}

bool IsWorthARevision(const std::vector<route::Segment>& before,
                      const refresh::Refreshed& refreshed) {
  const refresh::RefreshCounts& counts = refreshed.counts;
  return counts.added + counts.dropped > 0 ||
         counts.missed > kFewMissed * (counts.found + counts.missed) ||
         !std::equal(before.begin(), before.end(), refreshed.segments.begin(),
                     [](const route::Segment& a, const route::Segment& b) {
                       return a.key_views == b.key_views;
                     });
}

route::RouteInfo InfoOf(const AgentId& self, const route::RouteInfo& followed,
                        const refresh::Refreshed& refreshed, Refreshing how) {
  route::RouteInfo info = followed;
  info.key.teaching = MakeTeachingId();
  info.scout = self;
  info.taught_unix_ms = NowUnixMs();
  info.standing = route::Standing::kStaged;
  info.edition = 0;
  info.cut_off = false;
  info.to_review = how == Refreshing::kReview;
  info.refreshes = followed.revision;
  info.description = refresh::DescribeRefreshed(followed.revision, self, refreshed);
  const auto place = std::lower_bound(info.tags.begin(), info.tags.end(), refresh::kTag);
  const bool tagged = place != info.tags.end() && *place == refresh::kTag;
  if (!tagged && info.tags.size() < route::kMaxTags) info.tags.emplace(place, refresh::kTag);
  return info;
}

}  // namespace

const std::vector<std::string>& RefreshingNames() {
  static const std::vector<std::string> names = {"off", "review", "auto"};
  return names;
}

Refreshing RefreshingOf(const std::string& name) {
  if (name == "review") return Refreshing::kReview;
  return name == "auto" ? Refreshing::kAuto : Refreshing::kOff;
}

Result<route::RouteInfo> StoreRefreshed(const AgentId& self, const route::RouteInfo& followed,
                                        const refresh::Visit& visit, Refreshing how,
                                        store::RouteStore& store) {
  const auto segments = ReadAll(followed, store);
  if (!segments) return tl::unexpected(segments.error());
  const auto refreshed = refresh::Refresh(*segments, visit);
  if (!refreshed) return tl::unexpected(refreshed.error());
  if (!IsWorthARevision(*segments, *refreshed)) {
    return Fail(ErrorCode::kUnavailable, "it is as it was taught: {}",
                refresh::Describe(*refreshed));
  }
  std::vector<route::RouteInfo> one{InfoOf(self, followed, *refreshed, how)};
  if (auto numbered = exchange::GiveNumbers(store, one); !numbered) {
    return tl::unexpected(numbered.error());
  }
  const route::RouteKey key = one.front().key;
  Outbox outbox(self, store);
  if (auto begun = outbox.Begin(one.front()); !begun) return tl::unexpected(begun.error());
  for (const route::Segment& segment : refreshed->segments) {
    if (auto added = outbox.Add(key, segment); !added) return tl::unexpected(added.error());
  }
  if (auto done = outbox.Complete(key); !done) return tl::unexpected(done.error());
  return outbox.info(key);
}

void TellRefreshed(const Result<route::RouteInfo>& refreshed) {
  if (refreshed) {
    spdlog::info("{} is stored: {}", route::Describe(*refreshed), refreshed->description);
  } else if (refreshed.error().code == ErrorCode::kUnavailable) {
    spdlog::info("the route is not refreshed: {}", refreshed.error().message);
  } else {
    spdlog::warn("the route is not refreshed: {}", refreshed.error().message);
  }
}

}  // namespace trailcast::agent
