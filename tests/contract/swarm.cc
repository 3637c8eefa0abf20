#include "tests/contract/swarm.h"

#include <algorithm>
#include <stdexcept>

#include "services/exchange/publish.h"

namespace trailcast::test {
namespace {

using exchange::Message;
using route::RouteState;

constexpr std::chrono::milliseconds kStep{10};
constexpr std::size_t kPieceBytes = 2000;

// One turn of a program's loop; a refused message is lost, as in the programs.
template <typename Protocol>
void Turn(Protocol& protocol, exchange::RouteExchange& bus,
          std::chrono::steady_clock::time_point now, std::chrono::milliseconds wait) {
  for (const Message& message : bus.Take(wait)) protocol.Handle(message, now);
  const auto published = exchange::PublishAll(bus, protocol.Tick(now));
  if (!published && published.error().code != ErrorCode::kUnavailable) {
    throw std::runtime_error(published.error().message);
  }
}

}  // namespace

std::unique_ptr<exchange::FaultyExchange> Swarm::Open(const exchange::TopicUse& use) {
  return std::make_unique<exchange::FaultyExchange>(network_->Open(use), faults_, seed_++);
}

route::RouteInfo Swarm::Info() const {
  return InfoOf(key_, taught_, complete_ ? RouteState::kComplete : RouteState::kTeaching);
}

void Swarm::StartScout() {
  scout_ = Open(exchange::ScoutTopics());
  const auto unreceipted = scout_store_.UnreceiptedSegments(key_).value();
  std::vector<SegmentIndex> receipted;
  for (std::uint32_t i = 0; i < taught_.size(); ++i) {
    const bool open = std::count(unreceipted.begin(), unreceipted.end(), SegmentIndex(i)) > 0;
    if (!open) receipted.emplace_back(i);
  }
  const auto read = [this](SegmentIndex index) { return scout_store_.ReadSegment(key_, index); };
  const auto stored = scout_store_.SegmentDigests(key_).value();
  exchange::SegmentDigests held;
  for (const auto& segment : stored) {
    held.Put(segment.index, segment.digest);
  }
  sender_ = std::make_unique<exchange::RouteSender>(AgentId("scout-1"), Info(), read,
                                                    std::move(held), receipted);
}

void Swarm::StartServer() {
  server_ = Open(exchange::ServerTopics());
  const auto catalog = [this](const exchange::CatalogRequest&) {
    return exchange::CatalogReply{.page = {.routes = server_store_.ListRoutes().value()}};
  };
  keeper_ = exchange::RouteKeeper::Open(AgentId("server-1"), server_store_, {.answer = catalog},
                                        ToyIntegrity())
                .value();
}

Swarm::Follower& Swarm::AddFollower() {
  auto follower = std::make_unique<Follower>();
  follower->exchange = Open(exchange::FollowerTopics());
  if (!follower->exchange->Listen(exchange::Topic::kSegments, {key_}))
    throw std::runtime_error("cannot listen");
  const AgentId name(fmt::format("follower-{}", followers_.size() + 1));
  follower->fetcher = std::make_unique<exchange::RouteFetcher>(
      name, key_, std::vector<exchange::RouteFetcher::Held>(), ToyIntegrity(), now_);
  followers_.push_back(std::move(follower));
  return *followers_.back();
}

void Swarm::AddLender() {
  lenders_exchange_ = Open(exchange::FollowerTopics());
  lender_ = std::make_unique<exchange::PeerCache>(
      AgentId("lender"), [this](const route::RouteKey& key, SegmentIndex index) {
        return scout_store_.ReadSegment(key, index);
      });
  lender_->Hold({key_});
}

void Swarm::Teach(bool last) {
  const auto index = static_cast<std::uint32_t>(taught_.size());
  taught_.push_back(PieceOf(key_, index, kPieceBytes));
  complete_ = last;
  if (!scout_store_.AppendSegments(std::span(&taught_.back(), 1))) {
    throw std::runtime_error("the scout's store refused a segment");
  }
  if (sender_) sender_->Add(taught_.back(), Info());
}

void Swarm::Step() {
  now_ += kStep;
  if (sender_) {
    Turn(*sender_, *scout_, now_, wait_);
    if (!scout_store_.MarkReceipted(key_, sender_->TakeNewlyReceipted())) {
      throw std::runtime_error("the scout's store refused receipts");
    }
  }
  if (keeper_) Turn(*keeper_, *server_, now_, wait_);
  if (lender_) {
    if (!lenders_exchange_->Listen(exchange::Topic::kSegments, lender_->ListensTo(now_))) {
      throw std::runtime_error("cannot listen");
    }
    Turn(*lender_, *lenders_exchange_, now_, wait_);
  }
  for (const auto& follower : followers_) {
    Turn(*follower->fetcher, *follower->exchange, now_, wait_);
    for (route::SegmentPiece& piece : follower->fetcher->TakeArrived()) {
      follower->arrived.push_back(std::move(piece));
    }
  }
}

bool Swarm::EverythingArrived() const {
  return sender_->AllReceipted() &&
         std::all_of(followers_.begin(), followers_.end(),
                     [](const auto& follower) { return follower->fetcher->Complete(); });
}

bool Swarm::HoldsExactly(const std::vector<route::SegmentPiece>& got) const {
  std::vector<route::SegmentPiece> sorted = got;
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.index < b.index; });
  return sorted == taught_;
}

std::vector<route::SegmentPiece> Swarm::ServerPieces() {
  const std::vector<SegmentIndex> held = server_store_.HeldSegments(key_).value();
  std::vector<route::SegmentPiece> pieces;
  pieces.reserve(held.size());
  for (const SegmentIndex index : held) {
    pieces.push_back(server_store_.ReadSegment(key_, index).value());
  }
  return pieces;
}

}  // namespace trailcast::test
