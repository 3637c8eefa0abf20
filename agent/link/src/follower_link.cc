#include "agent/link/follower_link.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "agent/link/src/held_revisions.h"
#include "agent/link/src/route_ahead.h"
#include "services/base/guarded.h"
#include "services/base/time.h"
#include "services/exchange/publish.h"
#include "services/route/digest.h"
#include "services/route/route_ref.h"

namespace trailcast::agent {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kWait{20};
constexpr milliseconds kWaitFeeding{5};

exchange::AgentStatus FollowerStatus(const FollowerLinkOptions& options) {
  exchange::AgentStatus status;
  status.agent = options.agent;
  status.instance = options.instance;
  status.role = exchange::AgentRole::kFollower;
  status.route = options.route;
  return status;
}

NowHandler& HandlerOf(const FollowerLinkOptions& options, std::optional<NowHandler>& own) {
  return options.now_handler != nullptr ? *options.now_handler
                                        : own.emplace(options.agent, options.stop_file);
}

}  // namespace

FollowerLink::FollowerLink(FollowerLinkOptions options, std::unique_ptr<store::RouteStore> store,
                           std::unique_ptr<exchange::RouteExchange> exchange)
    : options_(std::move(options)),
      store_(std::move(store)),
      exchange_(std::move(exchange)),
      finder_(options_.agent, options_.route, options_.revision),
      peer_cache_(
          options_.agent,
          [this](const route::RouteKey& key, SegmentIndex index) {
            return store_->ReadSegment(key, index);
          },
          [this](const route::RouteKey& key) { return store_->FindRoute(key); }),
      place_note_(options_.place_file),
      neighbours_(options_.agent),
      now_handler_(HandlerOf(options_, own_handler_)),
      own_note_(options_.agent),
      followed_note_(options_.followed_note != nullptr ? *options_.followed_note : own_note_) {
  followed_note_.Begin();
  if (!exchange_) return;
  presence_.emplace(*exchange_, FollowerStatus(options_));
  presence_->FeelBy(options_.vitals);
}

FollowerLink::~FollowerLink() { Finish(); }

Result<void> FollowerLink::Start() {
  if (own_handler_) own_handler_->Load();
  if (!presence_ && now_handler_.hold().kind == Hold::Kind::kStopped) {
    return Fail(ErrorCode::kConflict,
                "{}; give --server, so that an operator can release it ('trailcast release {}')",
                now_handler_.hold().text, options_.agent.value());
  }
  if (presence_ && options_.instance == 0) {
    const auto handle = [this](const exchange::Message& message) {
      finder_.Handle(message);
      neighbours_.Handle(message, steady_clock::now());
      peer_cache_.Handle(message, steady_clock::now());
      HearOperators(message);
    };
    if (auto claimed = presence_->Claim(handle, options_.stop); !claimed) return claimed;
  }
  thread_ = std::thread([this] { Run(); });
  return {};
}

void FollowerLink::Report(const ReplayStep& step) {
  ReplayStep copy = step;
  // If the queue is full, the thread is busy with the disk and will get a newer report.
  [[maybe_unused]] const bool put = reports_.TryPut(std::move(copy));
  reported_.Ring();
}

void FollowerLink::Finish() {
  ending_ = true;
  reported_.Ring();
  if (thread_.joinable()) thread_.join();
}

void FollowerLink::Run() {
  auto worked = Guarded("the thread that fetches and stores the route", [this] { return Work(); });
  if (worked) return;
  while (!over() && !TryPut(worked.error())) reported_.Wait(kWait);
}

Result<void> FollowerLink::Work() {
  while (!over() && !TellHold()) reported_.Wait(kWait);
  if (auto told = TellHeld(); !told) return told;
  if (auto found = Find(); !found) return found;
  if (over()) return {};
  if (auto started = StartFetching(); !started) return started;
  return Follow();
}

Result<void> FollowerLink::StartFetching() {
  const route::RouteKey& key = route_->key;
  auto indices = store_->HeldSegments(key);
  if (!indices) return tl::unexpected(indices.error());
  std::vector<exchange::RouteFetcher::Held> held;
  for (const SegmentIndex index : *indices) {
    auto piece = store_->ReadSegment(key, index);
    if (piece) {
      held.push_back({index, piece->digest});
      CountHeld(index);
    } else if (exchange_ && piece.error().code == ErrorCode::kCorrupt) {
      spdlog::warn("fetching it anew: {}", piece.error().message);
    } else {
      return tl::unexpected(piece.error());
    }
  }
  spdlog::info("route '{}' {} of scout '{}', camera {}: {} segments so far, {} of them here",
               route_->name, route::ShortIds().Of(*route_), route_->scout.value(), route_->camera,
               route_->segment_count, held.size());
  held_before_ = static_cast<std::uint32_t>(held.size());
  if (exchange_) {
    if (auto made = MakeFetcher(held); !made) return made;
  } else if (route_->state == route::RouteState::kTeaching) {
    spdlog::warn("'{}' is unfinished in {}: following what is there", route_->name,
                 options_.store_file);
  }
  while (!over() && !TryPut(*route_)) reported_.Wait(kWait);
  if (const auto left = ReadPlace()) {
    while (!over() && !TryPut(*left)) reported_.Wait(kWait);
  }
  return {};
}

Result<void> FollowerLink::Follow() {
  while (!over()) {
    TakeReports();
    NotePlace();
    if (exchange_) {
      Trade();
      if (auto stored = StoreArrived(); !stored) return stored;
    } else {
      reported_.Wait(kWait);
    }
    if (auto fed = FeedAll(); !fed) return fed;
    HearWish();
    if (auto fed = FeedAhead(); !fed) return fed;
  }
  return {};
}

void FollowerLink::HearWish() {
  while (auto wish = wishes_.TryGet()) {
    ahead_ = std::make_unique<RouteAhead>(options_.agent, *std::move(wish), *store_,
                                          exchange_ != nullptr, steady_clock::now());
  }
}

Result<void> FollowerLink::FeedAhead() {
  if (!ahead_) return {};
  if (!exchange_) (void)ahead_->Tick(steady_clock::now());  // there is nobody to tell
  if (ahead_->TakeFetched()) {
    if (auto told = TellHeld(); !told) return told;
  }
  while (auto item = ahead_->Next()) {
    AheadFeed fed{ahead_->number(), *std::move(item)};
    if (ahead_feed_.TryPut(std::move(fed))) continue;
    ahead_->GiveBack(std::move(fed.item));
    break;
  }
  return {};
}

void FollowerLink::Trade() {
  auto messages = exchange_->Take(next_feed_ < held_ ? kWaitFeeding : kWait);
  const auto now = steady_clock::now();
  for (exchange::Message& message : messages) {
    HearOperators(message);
    presence_->Handle(message);
    neighbours_.Handle(message, now);
    peer_cache_.Handle(message, now);
    if (ahead_) ahead_->Handle(message, now);
    if (fetcher_) {
      fetcher_->Handle(std::move(message), now);
    } else {
      finder_.Handle(message);
    }
  }
  (void)TellHold();  // if the queue is full, the next messages repeat it
  AnswerOperators();
  if (auto listening = Listen(now); !listening) spdlog::debug("{}", listening.error().message);
  Say(now);
  if (presence_->server()) followed_note_.TellIfDue(*exchange_, now);
  HearServer();
  TellNeighbours(now);
  ShowStatus();
  presence_->Tick(now);
}

// It listens to segments of the route that it fetches, as long as it does, and of routes that it
// would serve to peers.
Result<void> FollowerLink::Listen(Time now) {
  std::set<route::RouteKey> routes = peer_cache_.ListensTo(now);
  const bool fetches = fetcher_ && !fetcher_->Complete() && !fetcher_->deleted();
  if (fetches) routes.insert(route_->key);
  if (const auto ahead = ahead_ ? ahead_->listens_to() : std::nullopt) routes.insert(*ahead);
  if (auto listening = exchange_->Listen(exchange::Topic::kSegments, routes); !listening) {
    return listening;
  }
  std::set<route::RouteKey> follows;
  if (route_) follows.insert(route_->key);
  return exchange_->Listen(exchange::Topic::kNeighbours, follows);
}

void FollowerLink::Say(steady_clock::time_point now) {
  auto outgoing = fetcher_ ? fetcher_->Tick(now) : finder_.Tick(now);
  if (ahead_ && fed_all_) {
    for (exchange::Message& ahead : ahead_->Tick(now)) outgoing.push_back(std::move(ahead));
  }
  for (exchange::Message& lent : peer_cache_.Tick(now)) outgoing.push_back(std::move(lent));
  const auto told = [this, now](const exchange::Message& message, bool sent) {
    if (!sent) peer_cache_.NotSent(message, now);
  };
  if (auto sent = exchange::PublishAll(*exchange_, outgoing, told); !sent) {
    spdlog::debug("{}", sent.error().message);
  }
}

Result<void> FollowerLink::StoreArrived() {
  const auto arrived = fetcher_->TakeArrived();
  if (!arrived.empty()) {
    if (auto appended = store_->AppendFetched(arrived); !appended) return appended;
    for (const route::SegmentPiece& piece : arrived) CountHeld(piece.index);
    fetched_ += static_cast<std::uint32_t>(arrived.size());
    spdlog::debug("{} segments of '{}' are here", held_, route_->name);
  }
  const auto progress = fetcher_->Progress(steady_clock::now());
  if (progress.state == exchange::FetchState::kWrong) return DropWrong(progress.held);
  if (fetcher_->deleted() && !fetcher_->Complete()) {
    return Fail(ErrorCode::kNotFound,
                "revision {} of route '{}' was deleted by an operator: {} of its {} segments are "
                "here",
                route_->revision.value(), route_->name, progress.held, progress.known);
  }
  waiting_for_ = progress.state == exchange::FetchState::kWaiting
                     ? "nobody who holds the route is heard"
                     : fmt::format("{} of {} segments here", progress.held, progress.known);
  return StoreNews();
}

Result<void> FollowerLink::StoreNews() {
  if (!fetcher_->info()) return {};
  route_ = *fetcher_->info();
  route::RouteInfo news = *route_;
  // The stored route counts as complete only when all of it is there and right.
  if (!fetcher_->Complete()) news.state = route::RouteState::kTeaching;
  if (news == stored_) return {};
  stored_ = news;
  if (auto put = store_->PutRoute(news); !put) return put;
  return news.state == route::RouteState::kComplete ? TellHeld() : Result<void>();
}

Result<void> FollowerLink::TellHeld() {
  auto held = HeldRevisions(*store_);
  if (!held) return tl::unexpected(held.error());
  held_revisions_ = std::move(*held);
  peer_cache_.Hold(held_revisions_);
  return {};
}

void FollowerLink::CountHeld(SegmentIndex stored) {
  beyond_.insert(stored);
  while (beyond_.erase(SegmentIndex(held_)) > 0) ++held_;
}

bool FollowerLink::all_known() const {
  if (fetcher_) return fetcher_->Complete() && next_feed_ == fetcher_->info()->segment_count;
  return next_feed_ == held_;
}

Result<void> FollowerLink::FeedAll() {
  if (!options_.feeds_segments) next_feed_ = held_;
  for (; next_feed_ < held_; ++next_feed_) {
    auto piece = store_->ReadSegment(route_->key, SegmentIndex(next_feed_));
    if (!piece) return tl::unexpected(piece.error());
    auto segment = route::Open(*piece);
    if (!segment) return tl::unexpected(segment.error());
    if (!TryPut(std::move(*segment))) return {};
  }
  if (!fed_all_ && all_known()) {
    fed_all_ = TryPut(RouteComplete{});
    if (fed_all_) spdlog::info("all {} segments of '{}' are here", next_feed_, route_->name);
  }
  return {};
}

bool FollowerLink::TryPut(Feed item) {
  const bool put = feed_.TryPut(std::move(item));
  if (put) fed_.Ring();
  return put;
}

}  // namespace trailcast::agent
