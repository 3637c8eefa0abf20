// This part of ScoutLink decides to which teaching the segments belong: a new one, or one that was
// cut off and continues.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "agent/link/scout_link.h"
#include "services/base/unix_time.h"
#include "services/exchange/revision_numbers.h"
#include "services/exchange/route_finder.h"
#include "services/route/digest.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {

// If several routes match, this agent's own is meant.
Result<std::vector<route::RouteInfo>> ScoutLink::FindMeant(const std::string& name_or_id) {
  auto meant = store_->FindMeant(name_or_id);
  if (!meant) return meant;
  const exchange::RevisionChoice newest{.newest = true};
  const auto rivals = exchange::FindRivals(*meant, newest);
  if (rivals.empty()) return meant;
  std::erase_if(*meant, [this](const auto& info) { return info.scout != options_.agent; });
  if (!meant->empty() && exchange::FindRivals(*meant, newest).empty()) return meant;
  return exchange::Ambiguous(name_or_id, rivals);
}

Result<void> ScoutLink::Assign(route::RouteInfo& route) {
  const auto earlier = FindMeant(route.name);
  if (!earlier) return tl::unexpected(earlier.error());
  if (earlier->empty()) {
    route.key = {MakeRouteId(), MakeTeachingId()};
    route.revision = RevisionNumber(1);
    return {};
  }
  route.key = {earlier->front().key.route, MakeTeachingId()};
  route.name = earlier->front().name;
  if (auto numbered = Number(route); !numbered) return numbered;
  spdlog::info(
      "route '{}' is known here: teaching it again, as {} unless a server numbers it otherwise",
      route.name, route::ShortIds().Of(route));
  return {};
}

Result<void> ScoutLink::Number(route::RouteInfo& route) {
  std::vector<route::RouteInfo> one{route};
  if (auto numbered = exchange::GiveNumbers(*store_, one); !numbered) return numbered;
  route.revision = one.front().revision;
  return {};
}

Result<std::optional<route::RouteInfo>> ScoutLink::FindCutOff(const std::string& route) {
  const auto named = store_->FindRoutesByName(route);
  if (!named) return tl::unexpected(named.error());
  const auto newest =
      std::find_if(named->begin(), named->end(),
                   [this](const route::RouteInfo& info) { return info.scout == options_.agent; });
  if (newest == named->end() || newest->standing == route::Standing::kRetired) return std::nullopt;
  if (newest->state == route::RouteState::kComplete && !newest->cut_off) return std::nullopt;
  const auto held = store_->HeldSegments(newest->key);
  if (!held) return tl::unexpected(held.error());
  return held->empty() ? std::nullopt : std::optional(*newest);
}

Result<route::Segment> ScoutLink::LastSegment(const route::RouteInfo& cut_off) {
  const auto held = store_->HeldSegments(cut_off.key);
  if (!held) return tl::unexpected(held.error());
  const auto piece = store_->ReadSegment(cut_off.key, held->back());
  return piece ? route::Open(*piece) : tl::unexpected(piece.error());
}

Result<void> ScoutLink::Discard(const route::RouteInfo& cut_off) {
  const auto discarded = outbox_.Discard(cut_off, exchange_ != nullptr);
  if (!discarded) return tl::unexpected(discarded.error());
  spdlog::info("{}", *discarded);
  return {};
}

// An end that was announced stays, so the continuation is another teaching that begins with the
// same segments.
Result<void> ScoutLink::GoOn(const route::RouteInfo& cut_off) {
  route::RouteInfo route = cut_off;
  if (cut_off.state == route::RouteState::kComplete) {
    route.key.teaching = MakeTeachingId();
    route.taught_unix_ms = NowUnixMs();
    route.standing = route::Standing::kStaged;
    route.edition = 0;
    if (auto numbered = Number(route); !numbered) return numbered;
  }
  if (auto begun = outbox_.GoOn(cut_off, route); !begun) return begun;
  key_ = route.key;
  planned_ = outbox_.info(*key_);
  spdlog::info("going on with {}: {} segments are there", route::Describe(*planned_),
               planned_->segment_count);
  return {};
}

}  // namespace trailcast::agent
