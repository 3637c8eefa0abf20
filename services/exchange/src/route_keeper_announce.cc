// This is how RouteKeeper announces its routes: as far as they are durable, once the store has it.
#include <algorithm>
#include <set>
#include <utility>

#include "services/exchange/revision_numbers.h"
#include "services/exchange/route_keeper.h"
#include "services/route/labels.h"

namespace trailcast::exchange {

using route::RouteInfo;
using route::RouteKey;
using route::RouteState;

bool RouteKeeper::ManifestIsRight(const RouteInfo& info, const KeptRoute& kept, Time now) {
  std::vector<route::Digest> digests;
  for (std::uint32_t i = 0; i < info.segment_count; ++i) {
    digests.push_back(kept.DigestOf(SegmentIndex(i)).value_or(route::Digest{}));
  }
  if (integrity_.manifest(digests) == info.manifest_digest) return true;
  Refuse({ErrorCode::kConflict,
          fmt::format("{} was announced complete, but its {} segments held here are not those of "
                      "its manifest; teach it again",
                      Describe(info), info.segment_count)},
         info.key, now);
  return false;
}

void RouteKeeper::Announce(Time now, std::vector<Message>& out) {
  std::vector<RouteInfo> again;
  std::vector<RouteInfo> grown;
  std::vector<RouteInfo> completing;
  const bool grown_too = now >= grown_due_;
  if (grown_too) grown_due_ = now + options_.announced_together;
  for (auto& [key, kept] : routes_) {
    auto info = News(kept, now, grown_too);
    if (!info) continue;
    const bool stored_already = info == kept.stored();
    const bool completes = !kept.complete() && info->state == RouteState::kComplete;
    (stored_already ? again : completes ? completing : grown).push_back(std::move(*info));
  }
  std::vector<RouteKey> stored;
  StoreInfos(grown, false, now, stored);
  const std::size_t completed_from = stored.size();
  StoreInfos(completing, true, now, stored);
  for (std::size_t i = completed_from; i < stored.size(); ++i) TellComplete(stored[i], now);
  for (const RouteInfo& info : again) stored.push_back(info.key);
  for (const RouteKey& key : stored) {
    KeptRoute& kept = routes_.at(key);
    kept.resend_due = false;
    out.emplace_back(RouteAnnouncement{.holder = self_, .info = *kept.stored()});
  }
}

Result<void> RouteKeeper::ActivateFirst(std::vector<RouteInfo>& completing) {
  std::sort(completing.begin(), completing.end(),
            [](const RouteInfo& a, const RouteInfo& b) { return a.revision < b.revision; });
  std::set<RouteId> activated;
  for (RouteInfo& info : completing) {
    const bool staged = info.standing == route::Standing::kStaged;
    if (!staged || info.held_back() || activated.contains(info.key.route)) continue;
    if (routes_.at(info.key).completed_elsewhere) continue;
    const auto revisions = store_.FindRevisions(info.key.route);
    if (!revisions) return tl::unexpected(revisions.error());
    const bool edited = std::any_of(
        revisions->begin(), revisions->end(),
        [](const RouteInfo& each) { return each.standing != route::Standing::kStaged; });
    if (edited) continue;
    info.standing = route::Standing::kActive;
    ++info.edition;
    activated.insert(info.key.route);
  }
  return {};
}

std::optional<RouteInfo> RouteKeeper::News(KeptRoute& kept, Time now, bool grown_too) {
  const bool too_soon =
      kept.announced_at && (!grown_too || now < *kept.announced_at + options_.announce_every);
  if (!kept.announce_due || too_soon) return std::nullopt;
  kept.announce_due = false;
  std::optional<RouteInfo> durable = kept.DurableInfo();
  const bool stored_already = durable && durable == kept.stored();
  if (!durable || (stored_already && !kept.resend_due)) return std::nullopt;
  kept.announced_at = now;
  const bool completes = durable->state == RouteState::kComplete && !kept.complete() &&
                         durable->standing != route::Standing::kDeleted;
  if (completes && !ManifestIsRight(*durable, kept, now)) {
    kept.ForgetClaim();
    return std::nullopt;
  }
  return durable;
}

Result<void> RouteKeeper::Put(std::span<const RouteInfo> infos, bool completing, Time now) {
  const bool labels_too = std::any_of(infos.begin(), infos.end(), [&](const RouteInfo& info) {
    const auto& stored = routes_.at(info.key).stored();
    return !stored || route::HasLaterLabels(info, *stored);
  });
  if (!completing && !labels_too) return store_.PutRoutes(infos);
  // Two servers must not give the same number, nor activate different revisions.
  std::vector<RouteInfo> reconciled;
  auto put = store_.Exclusively([&] {
    return PutTogether({infos.begin(), infos.end()}, completing, reconciled);
  });
  if (!put) return put;
  for (const RouteInfo& info : reconciled) {
    AddNote(Note::Severity::kWarning, "reconciled/" + Describe(info.key),
            fmt::format("{} is {} from now on: another server, out of reach of this one, had made "
                        "something else of the route",
                        Describe(info), route::NameOf(info.standing)),
            now);
    TellRelabelled(info, now);
  }
  return {};
}

Result<void> RouteKeeper::PutTogether(std::vector<RouteInfo> infos, bool completing,
                                      std::vector<RouteInfo>& reconciled) {
  const auto unnumbered = std::partition(infos.begin(), infos.end(), [&](const RouteInfo& info) {
    return routes_.at(info.key).numbered_elsewhere;
  });
  if (auto numbered = GiveNumbers(store_, {unnumbered, infos.end()}); !numbered) return numbered;
  if (completing) {
    if (auto chosen = ActivateFirst(infos); !chosen) return chosen;
  }
  if (auto put = store_.PutRoutes(infos); !put) return put;
  std::set<RouteId> routes;
  for (const RouteInfo& info : infos) routes.insert(info.key.route);
  reconciled.clear();
  for (const RouteId& route : routes) {
    auto changed = Disagreements(store_, route);
    if (!changed) return tl::unexpected(changed.error());
    reconciled.insert(reconciled.end(), changed->begin(), changed->end());
  }
  return reconciled.empty() ? Result<void>() : store_.PutRoutes(reconciled);
}

// This is one commit. If the store refuses the group because of one route, each is tried alone.
void RouteKeeper::StoreInfos(std::span<const RouteInfo> infos, bool completing, Time now,
                             std::vector<RouteKey>& stored) {
  if (infos.empty()) return;
  const auto put = Put(infos, completing, now);
  const bool is_away = !put && put.error().code == ErrorCode::kUnavailable;
  routes_untaken_ = is_away ? put.error().message : "";
  if (put) {
    for (const RouteInfo& info : infos) MarkStored(info, now, stored);
  } else if (infos.size() > 1 && !is_away) {
    for (const RouteInfo& info : infos) StoreInfos({&info, 1}, completing, now, stored);
  } else {
    Refuse(put.error(), infos.front().key, now);
    for (const RouteInfo& info : infos) {
      KeptRoute& kept = routes_.at(info.key);
      if (put.error().code == ErrorCode::kConflict) {
        kept.ForgetClaim();
      } else {
        kept.announce_due = true;  // the disk was full: it is tried again when it may have room
      }
    }
  }
}

// The store's version counts, since another server may have stored later news.
void RouteKeeper::MarkStored(const RouteInfo& info, Time now, std::vector<RouteKey>& stored) {
  KeptRoute& kept = routes_.at(info.key);
  const auto found = store_.FindRoute(info.key);
  if (!found || !*found) {
    kept.announce_due = true;
    return;
  }
  kept.MarkStored(**found);
  if ((*found)->segment_count > info.segment_count) Refresh(info.key, kept, now);
  stored.push_back(info.key);
}

void RouteKeeper::TellComplete(const RouteKey& key, Time now) {
  KeptRoute& kept = routes_.at(key);
  if (!kept.complete()) return;
  const RouteInfo& info = *kept.stored();
  kept.receipt_due = true;
  kept.receipt_at.reset();
  AddNote(Note::Severity::kInfo, "complete/" + Describe(key),
          fmt::format("{} is complete{}{}: {} segments, {:.1f} m", Describe(info),
                      info.cut_off ? " as far as it was taught before its scout ended" : "",
                      info.to_review ? ", and is to be reviewed" : "", info.segment_count,
                      info.length_m),
          now);
}

}  // namespace trailcast::exchange
