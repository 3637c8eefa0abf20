// This part of FollowerLink gets a route: its fetcher, and what becomes of wrong segments.
#include <fmt/ranges.h>
#include <spdlog/spdlog.h>

#include <set>
#include <vector>

#include "agent/link/follower_link.h"
#include "agent/link/src/fetcher_for.h"
#include "services/route/labels.h"

namespace trailcast::agent {
namespace {

std::string Names(const std::set<AgentId>& senders) {
  std::vector<std::string> names;
  names.reserve(senders.size());
  for (const AgentId& sender : senders) names.push_back("'" + sender.value() + "'");
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Result<void> FollowerLink::MakeFetcher(const std::vector<exchange::RouteFetcher::Held>& held) {
  const auto now = std::chrono::steady_clock::now();
  const route::RouteKey key = route_->key;
  auto made = FetcherFor(options_.agent, key, held, *store_, now);
  if (!made) return tl::unexpected(made.error());
  fetcher_.emplace(std::move(*made));
  fetcher_->Learn(*route_, now);
  // The own store may know more than the finder heard.
  auto own = store_->FindRoute(key);
  if (!own) return tl::unexpected(own.error());
  stored_ = *own;
  if (stored_) fetcher_->Learn(*stored_, now);
  if (auto listening = Listen(now); !listening) return listening;
  Say(now);  // its first requests, at once
  return {};
}

// Each segment is whole, but together they are not the route that the scout announced.
Result<void> FollowerLink::DropWrong(std::uint32_t count) {
  const std::set<AgentId> senders = fetcher_->senders();
  if (auto dropped = store_->DropSegments(route_->key); !dropped) return dropped;
  const std::string wrong =
      fmt::format("the {} segments of {} in {} are not those that its scout announced", count,
                  route::Describe(*route_), options_.store_file);
  if (dropped_wrong_ || held_before_ == 0) {
    return Fail(ErrorCode::kCorrupt,
                "{}, and were dropped: {} sent them and has others than the scout '{}'; delete the "
                "revision there, or have it taught again",
                wrong, Names(senders), route_->scout.value());
  }
  if (options_.feeds_segments && next_feed_ > 0) {
    return Fail(ErrorCode::kCorrupt,
                "{}: they were dropped; start again, and the route is fetched anew", wrong);
  }
  spdlog::warn("{}: fetching them anew", wrong);
  dropped_wrong_ = true;
  beyond_.clear();
  held_ = held_before_ = next_feed_ = 0;
  return MakeFetcher({});
}

}  // namespace trailcast::agent
