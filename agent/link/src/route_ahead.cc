#include "agent/link/src/route_ahead.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "agent/link/src/fetcher_for.h"
#include "services/route/digest.h"

namespace trailcast::agent {
namespace {

// A server has so long to say which revision is meant; after that, the own store's counts.
constexpr std::chrono::milliseconds kSaysWithin{3000};

}  // namespace

RouteAhead::RouteAhead(const AgentId& self, RouteWish wish, store::RouteStore& store, bool online,
                       Time now)
    : self_(self),
      wish_(std::move(wish)),
      store_(store),
      online_(online),
      began_(now),
      finder_(self, wish_.route, wish_.revision) {}

void RouteAhead::Handle(const exchange::Message& message, Time now) {
  if (fetcher_) {
    fetcher_->Handle(message, now);
  } else if (!route_) {
    finder_.Handle(message);
  }
}

std::vector<exchange::Message> RouteAhead::Tick(Time now) {
  if (fails_ || all_here_) return {};
  if (!route_) Choose(now);
  if (fetcher_) StoreArrived(now);
  if (fails_ || all_here_ || !online_) return {};
  return fetcher_ ? fetcher_->Tick(now) : finder_.Tick(now);
}

void RouteAhead::Choose(Time now) {
  route_ = finder_.found();
  if (!route_ && online_ && now - began_ < kSaysWithin) return;
  if (!route_) {
    const auto meant = store_.FindMeant(wish_.route);
    const auto own = meant ? exchange::ChooseMeant(wish_.route, *meant, wish_.revision)
                           : Result<std::optional<route::RouteInfo>>(tl::unexpected(meant.error()));
    if (own) route_ = *own;
  }
  if (!route_ || route_->state != route::RouteState::kComplete) {
    fails_ = true;
    return;
  }
  const auto held = store_.FindRoute(route_->key);
  all_here_ = held && *held && (*held)->state == route::RouteState::kComplete;
  if (!all_here_) FetchMissing(now);
}

void RouteAhead::FetchMissing(Time now) {
  const auto indices = store_.HeldSegments(route_->key);
  fails_ = !online_ || !indices;
  if (fails_) return;
  std::vector<exchange::RouteFetcher::Held> held;
  for (const SegmentIndex index : *indices) {
    if (const auto piece = store_.ReadSegment(route_->key, index)) {
      held.push_back({index, piece->digest});
    }
  }
  auto made = FetcherFor(self_, route_->key, held, store_, now);
  fails_ = !made;
  if (fails_) return;
  fetcher_.emplace(std::move(*made));
  fetcher_->Learn(*route_, now);
  route::RouteInfo begun = *route_;
  begun.state = route::RouteState::kTeaching;  // until all of it is here, and right
  fails_ = !store_.PutRoute(begun);
}

void RouteAhead::StoreArrived(Time now) {
  const auto arrived = fetcher_->TakeArrived();
  if (!arrived.empty() && !store_.AppendFetched(arrived)) fails_ = true;
  const auto state = fetcher_->Progress(now).state;
  if (state == exchange::FetchState::kWrong || fetcher_->deleted()) fails_ = true;
  if (fails_ || !fetcher_->Complete()) return;
  route_ = *fetcher_->info();
  fails_ = !store_.PutRoute(*route_);
  all_here_ = fetched_ = !fails_;
  fetcher_.reset();
  if (all_here_) spdlog::info("all of '{}' is here, for what comes next", route_->name);
}

std::optional<route::RouteKey> RouteAhead::listens_to() const {
  return fetcher_ && !fails_ ? std::optional(route_->key) : std::nullopt;
}

std::optional<Feed> RouteAhead::Next() {
  if (given_back_) return std::exchange(given_back_, std::nullopt);
  return all_here_ && !fails_ ? Read() : std::nullopt;
}

std::optional<Feed> RouteAhead::Read() {
  switch (fed_) {
    case Fed::kNothing:
      fed_ = Fed::kRoute;
      return *route_;
    case Fed::kRoute:
      fed_ = Fed::kSegments;
      if (wish_.begin_m > 0.0) return LeftAt{.along_m = wish_.begin_m};
      [[fallthrough]];
    case Fed::kSegments:
      break;
    case Fed::kAll:
      return std::nullopt;
  }
  if (next_ == route_->segment_count) {
    fed_ = Fed::kAll;
    return RouteComplete{};
  }
  const auto piece = store_.ReadSegment(route_->key, SegmentIndex(next_++));
  auto segment = piece ? route::Open(*piece) : tl::unexpected(piece.error());
  if (segment) return *std::move(segment);
  fails_ = true;
  return segment.error();
}

}  // namespace trailcast::agent
