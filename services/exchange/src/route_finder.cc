#include "services/exchange/route_finder.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <variant>

namespace trailcast::exchange {

std::optional<route::RouteInfo> ChooseRoute(const std::vector<route::RouteInfo>& routes,
                                            const RevisionChoice& which) {
  using route::Standing;
  std::set<RouteId> spoken_of;
  for (const route::RouteInfo& info : routes) {
    if (info.edition > 0) spoken_of.insert(info.key.route);
  }
  const bool to_follow = which.number == 0 && !which.newest;
  const auto is_meant = [&](const route::RouteInfo& info) {
    if (info.standing == Standing::kDeleted) return false;
    if (!which.scout.empty() && info.scout.value() != which.scout) return false;
    if (which.number != 0) return info.revision.value() == which.number;
    if (which.newest) return info.standing != Standing::kRetired;
    const bool unsaid = !spoken_of.contains(info.key.route) && !info.cut_off;
    return info.standing == Standing::kActive || unsaid;
  };
  const auto rank = [&](const route::RouteInfo& info) {
    return std::make_tuple(to_follow && info.standing == Standing::kActive,
                           info.state == route::RouteState::kComplete, info.revision,
                           info.taught_unix_ms, info.key);
  };
  const route::RouteInfo* best = nullptr;
  for (const route::RouteInfo& info : routes) {
    if (is_meant(info) && (best == nullptr || rank(*best) < rank(info))) best = &info;
  }
  return best == nullptr ? std::nullopt : std::optional(*best);
}

std::vector<route::RouteInfo> FindRivals(const std::vector<route::RouteInfo>& routes,
                                         const RevisionChoice& which) {
  std::map<RouteId, std::vector<route::RouteInfo>> by_id;
  for (const route::RouteInfo& info : routes) by_id[info.key.route].push_back(info);
  std::vector<route::RouteInfo> rivals;
  for (const auto& [id, revisions] : by_id) {
    if (auto meant = ChooseRoute(revisions, which)) rivals.push_back(std::move(*meant));
  }
  if (rivals.size() < 2) rivals.clear();
  return rivals;
}

tl::unexpected<Error> Ambiguous(const std::vector<route::RouteInfo>& rivals) {
  constexpr std::size_t kShown = 4;
  std::string shown;
  for (std::size_t i = 0; i < std::min(kShown, rivals.size()); ++i) {
    shown += fmt::format("{}of scout '{}' (revision {}, {} segments, {:.1f} m, id {})",
                         i == 0 ? "" : ", ", rivals[i].scout.value(), rivals[i].revision.value(),
                         rivals[i].segment_count, rivals[i].length_m, rivals[i].key.route.value());
  }
  return Fail(ErrorCode::kConflict,
              "{} routes have the name '{}': {}{}; say which with --scout, or rename one "
              "('trailcast routes rename ID NAME')",
              rivals.size(), rivals.front().name, shown, rivals.size() > kShown ? ", .." : "");
}

void RouteFinder::Handle(const exchange::Message& message) {
  if (found_) return;
  if (const auto* reply = std::get_if<exchange::CatalogReply>(&message)) {
    Learn(*reply);
  } else if (const auto* announcement = std::get_if<exchange::RouteAnnouncement>(&message)) {
    Learn(*announcement);
  }
}

void RouteFinder::Learn(const exchange::RouteAnnouncement& announcement) {
  if (announcement.info.name != name_) return;
  const auto known =
      std::find_if(announced_.begin(), announced_.end(),
                   [&](const route::RouteInfo& info) { return info.key == announcement.info.key; });
  if (known != announced_.end()) {
    *known = announcement.info;
  } else if (announced_.size() < kMaxAnnounced) {
    announced_.push_back(announcement.info);
  }
}

void RouteFinder::Learn(const exchange::CatalogReply& reply) {
  if (reply.client != self_ || reply.request == 0 || reply.request > asked_) return;
  error_ = reply.error;
  if (!reply.error.empty()) return;
  std::vector<route::RouteInfo> named = reply.page.routes;
  std::erase_if(named, [&](const route::RouteInfo& info) { return info.name != name_; });
  rivals_ = FindRivals(named, which_);
  if (!rivals_.empty()) return;
  found_ = ChooseRoute(named, which_);
  if (!found_) unknown_ = Unknown{reply.server, reply.similar_names, !named.empty()};
}

std::vector<exchange::Message> RouteFinder::Tick(Time now) {
  if (found_ || (asked_at_ && now - *asked_at_ < kAskEvery)) return {};
  asked_at_ = now;
  ++asked_;
  return {exchange::CatalogRequest{self_, asked_, {.name = name_}}};
}

}  // namespace trailcast::exchange
