#include "route_server/routes/history.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "services/base/text.h"
#include "services/exchange/bounds.h"

namespace trailcast::server {
namespace {

using network::Change;
using route::RouteInfo;
using route::Standing;

std::string NameOf(const RouteInfo& info) {
  return fmt::format("{}@{}", info.name, info.revision.value());
}

std::string StoredText(const RouteInfo& info) {
  std::string text = "stored " + NameOf(info);
  if (info.length_m > 0.0) text += fmt::format(", {:.1f} m", info.length_m);
  if (info.cut_off) text += ", cut off";
  if (info.to_review) text += ", to be reviewed";
  if (info.standing == Standing::kActive) text += ", active";
  return text;
}

// Returns those that are not among the others; both are in rising order.
std::vector<std::string> Without(const std::vector<std::string>& these,
                                 const std::vector<std::string>& others) {
  std::vector<std::string> left;
  std::set_difference(these.begin(), these.end(), others.begin(), others.end(),
                      std::back_inserter(left));
  return left;
}

// If another revision becomes active instead, that one's change tells it.
std::string StandingText(const RouteInfo& now) {
  switch (now.standing) {
    case Standing::kActive:
      return "activated " + NameOf(now);
    case Standing::kRetired:
      return "retired " + NameOf(now);
    case Standing::kDeleted:
      return "deleted " + NameOf(now);
    case Standing::kStaged:
      break;
  }
  return "";
}

std::vector<std::string> Differences(const RouteInfo& before, const RouteInfo& now) {
  std::vector<std::string> told;
  if (now.name != before.name) told.push_back("renamed " + before.name + " to " + now.name);
  if (now.standing != before.standing) {
    if (std::string text = StandingText(now); !text.empty()) told.push_back(std::move(text));
  }
  if (const auto added = Without(now.tags, before.tags); !added.empty()) {
    told.push_back(fmt::format("tagged {} {}", NameOf(now), fmt::join(added, " ")));
  }
  if (const auto gone = Without(before.tags, now.tags); !gone.empty()) {
    told.push_back(fmt::format("untagged {} {}", NameOf(now), fmt::join(gone, " ")));
  }
  if (now.description != before.description) {
    told.push_back(fmt::format("described {}: {}", NameOf(now), now.description));
  }
  return told;
}

}  // namespace

Result<std::unique_ptr<History>> History::Open(AgentId server,
                                               std::unique_ptr<store::HistoryStore> store,
                                               store::RouteStore& routes,
                                               std::int64_t now_unix_ms) {
  std::unique_ptr<History> history(new History(std::move(server), std::move(store), routes));
  const auto began = history->store_->KeptSince(now_unix_ms);
  if (!began) return tl::unexpected(began.error());
  history->began_unix_ms_ = *began;
  return history;
}

// The time at which the server stored it tells whether that was since then.
Result<std::vector<Change>> History::FirstSeen(const RouteInfo& info) {
  const auto teachings = routes_.FindTeachings(info.key.route);
  if (!teachings) return tl::unexpected(teachings.error());
  const auto known = std::find_if(
      teachings->begin(), teachings->end(),
      [&](const store::KnownTeaching& each) { return each.teaching == info.key.teaching; });
  if (known == teachings->end() || known->grown_unix_ms < began_unix_ms_) {
    return std::vector<Change>();
  }
  return std::vector<Change>{{known->grown_unix_ms, info.scout.value(), StoredText(info)}};
}

Result<void> History::Note(std::span<const RouteInfo> infos, const std::string& by,
                           std::int64_t now_unix_ms) {
  std::vector<Change> changes;
  std::vector<RouteInfo> noted;
  for (const RouteInfo& info : infos) {
    if (info.state != route::RouteState::kComplete) continue;
    const auto before = store_->Noted(info.key);
    if (!before) return tl::unexpected(before.error());
    if (*before == info) continue;
    if (*before) {
      for (std::string& text : Differences(**before, info)) {
        Change change{now_unix_ms, by, PlainText(text, exchange::kMaxLineBytes / 2)};
        // All revisions share a name, so its change is listed once.
        const bool told = std::find(changes.begin(), changes.end(), change) != changes.end();
        if (!told) changes.push_back(std::move(change));
      }
    } else if (info.standing == Standing::kDeleted) {
      continue;  // it is a repetition
    } else {
      auto first = FirstSeen(info);
      if (!first) return tl::unexpected(first.error());
      std::move(first->begin(), first->end(), std::back_inserter(changes));
    }
    noted.push_back(info);
  }
  return noted.empty() ? Result<void>() : store_->Note(changes, noted);
}

Result<void> History::NoteStored(std::span<const route::RouteKey> keys, const std::string& by,
                                 std::int64_t now_unix_ms) {
  std::vector<RouteInfo> infos;
  for (const route::RouteKey& key : keys) {
    auto info = routes_.FindRoute(key);
    if (!info) return tl::unexpected(info.error());
    if (*info) infos.push_back(**std::move(info));
  }
  return Note(infos, by, now_unix_ms);
}

exchange::NetworkReply History::Answer(const exchange::NetworkRequest& request,
                                       std::int64_t since_unix_ms, std::int64_t now_unix_ms) {
  exchange::NetworkReply reply{
      .server = server_, .client = request.client, .request = request.request};
  if (auto filled = FillReply(request, since_unix_ms, now_unix_ms, reply); !filled) {
    reply.lines.clear();
    reply.error = PlainText(filled.error().message, exchange::kMaxLineBytes);
  }
  return reply;
}

// The first line says since when changes are kept.
Result<void> History::FillReply(const exchange::NetworkRequest& request, std::int64_t since_unix_ms,
                                std::int64_t now_unix_ms, exchange::NetworkReply& reply) {
  constexpr std::size_t kPage = exchange::kMaxNetworkLines - 1;
  if (request.first == 0) {
    const auto kept_since = store_->KeptSince(now_unix_ms);
    if (!kept_since) return tl::unexpected(kept_since.error());
    reply.lines.push_back(network::KeptSince(*kept_since));
  }
  const auto changes = store_->Since(since_unix_ms, request.first, kPage + 1);
  if (!changes) return tl::unexpected(changes.error());
  const std::size_t told = std::min(changes->size(), kPage);
  for (std::size_t i = 0; i < told; ++i) reply.lines.push_back(network::ToText((*changes)[i]));
  if (told < changes->size()) reply.next = request.first + static_cast<std::uint32_t>(told);
  return {};
}

}  // namespace trailcast::server
