#include "services/exchange/route_finder.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <variant>

#include "services/base/unix_time.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::exchange {
namespace {

constexpr std::size_t kMostNamed = 4;  // revisions in one message

std::vector<route::RouteInfo> NewestFirst(std::vector<route::RouteInfo> revisions) {
  std::sort(revisions.begin(), revisions.end(),
            [](const auto& a, const auto& b) { return a.revision > b.revision; });
  return revisions;
}

}  // namespace

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
    if (info.standing == Standing::kRetired) return false;
    if (which.newest) return true;
    const bool unsaid = !spoken_of.contains(info.key.route) && !info.held_back();
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

tl::unexpected<Error> Ambiguous(const std::string& name_or_id,
                                const std::vector<route::RouteInfo>& rivals) {
  const route::ShortIds ids(rivals);
  std::string shown;
  for (const route::RouteInfo& info :
       std::span(rivals).first(std::min(kMostNamed, rivals.size()))) {
    shown += fmt::format("{}{} '{}' of scout '{}' ({}, {})", shown.empty() ? "" : "; ",
                         ids.Of(info), info.name, info.scout.value(), DateText(info.taught_unix_ms),
                         info.length_m > 0.0 ? fmt::format("{:.1f} m", info.length_m)
                                             : fmt::format("{} segments", info.segment_count));
  }
  return Fail(ErrorCode::kConflict,
              "'{}' may be any of {} routes, give the id of one instead: {}{}", name_or_id,
              rivals.size(), shown, rivals.size() > kMostNamed ? "; .." : "");
}

std::string NotMeantText(const std::string& holder, const std::string& name_or_id,
                         const std::vector<route::RouteInfo>& others, const RevisionChoice& which) {
  const auto newest_first = NewestFirst(others);
  const route::ShortIds ids(newest_first);
  std::vector<std::string> shown;
  for (const route::RouteInfo& info :
       std::span(newest_first).first(std::min(kMostNamed, newest_first.size()))) {
    shown.push_back(fmt::format("{} ({})", ids.Of(info), route::StateText(info)));
  }
  if (newest_first.size() > kMostNamed) shown.emplace_back("..");
  return fmt::format(
      "{} has no {} of route '{}'{}; it has {}", holder,
      which.number != 0 ? fmt::format("revision {}", which.number) : "active revision", name_or_id,
      which.scout.empty() ? "" : fmt::format(" of scout '{}'", which.scout),
      fmt::join(shown, ", "));
}

Error NotMeant(const std::string& holder, const std::string& name_or_id,
               const std::vector<route::RouteInfo>& others, const RevisionChoice& which) {
  std::string text = NotMeantText(holder, name_or_id, others, which);
  if (which.number != 0) return {ErrorCode::kNotFound, std::move(text)};
  const auto newest_first = NewestFirst(others);
  const route::RouteInfo& newest = newest_first.front();
  const std::string id = route::ShortIds(newest_first).Of(newest);
  const bool is_cut_off = newest.cut_off && newest.standing == route::Standing::kStaged;
  if (is_cut_off) {
    text +=
        ": its teaching was cut off, and robots follow no revision of it; teach it again, or "
        "finish it with 'trailcast-agent teach --unfinished go-on'";
  }
  text += fmt::format(
      "{} 'trailcast routes activate {}' has robots follow {}, and {} in place of the name means "
      "it alone",
      is_cut_off ? ";" : ":", id, is_cut_off ? "it as far as it goes" : "it", id);
  return {ErrorCode::kNotFound, std::move(text)};
}

Result<std::optional<route::RouteInfo>> ChooseMeant(const std::string& name_or_id,
                                                    const std::vector<route::RouteInfo>& routes,
                                                    const RevisionChoice& which) {
  const auto rivals = FindRivals(routes, which);
  if (!rivals.empty()) return Ambiguous(name_or_id, rivals);
  return ChooseRoute(routes, which);
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
  if (!route::IsMeantBy(announcement.info, name_or_id_)) return;
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
  const auto meant = route::OnlyMeant(reply.page.routes, name_or_id_);
  rivals_ = FindRivals(meant, which_);
  if (!rivals_.empty()) return;
  found_ = ChooseRoute(meant, which_);
  if (found_) return;
  const bool others_have_more =
      unknown_ && unknown_->server != reply.server && !unknown_->others.empty() && meant.empty();
  if (!others_have_more) unknown_ = Unknown{reply.server, reply.similar_names, meant};
  if (unknown_to_.size() < kMaxAnnounced) unknown_to_.insert(reply.server);
}

bool RouteFinder::IsUnknownTo(const std::set<AgentId>& servers) const {
  return std::includes(unknown_to_.begin(), unknown_to_.end(), servers.begin(), servers.end());
}

std::vector<exchange::Message> RouteFinder::Tick(Time now) {
  if (found_ || (asked_at_ && now - *asked_at_ < kAskEvery)) return {};
  asked_at_ = now;
  ++asked_;
  return {exchange::CatalogRequest{self_, asked_, {.name = name_or_id_}}};
}

}  // namespace trailcast::exchange
