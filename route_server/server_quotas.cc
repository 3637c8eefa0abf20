// This part of the server limits what it takes from members and sends to them.
#include <map>

#include "route_server/server.h"

namespace trailcast::server {

using std::chrono::steady_clock;

void Server::Limit(const QuotaOptions& options) {
  quotas_.emplace(options, [this](const AgentId& scout) { return LookUp(scout); });
}

Result<Quotas::Stored> Server::LookUp(const AgentId& scout) {
  route::RouteQuery query{.scout = scout.value(), .page_size = store::RouteStore::kMaxPage};
  Quotas::Stored stored;
  do {
    const auto page = store_->QueryRoutes(query);
    if (!page) return tl::unexpected(page.error());
    for (const route::RouteInfo& info : page->routes) stored.bytes += info.bytes;
    stored.routes = page->total;
    query.cursor = page->next;
  } while (!query.cursor.empty());
  return stored;
}

std::optional<exchange::Message> Server::WithinQuotas(const exchange::Message& message) {
  const auto now = steady_clock::now();
  if (const auto* batch = std::get_if<exchange::SegmentBatch>(&message)) {
    // Segments from other servers were requested.
    if (presence_.servers().contains(batch->sender)) return message;
    exchange::SegmentBatch allowed = WithinQuotas(*batch);
    if (allowed.pieces.empty()) return std::nullopt;
    return allowed;
  }
  if (const auto* request = std::get_if<exchange::SegmentRequest>(&message)) {
    if (presence_.servers().contains(request->requester) || request->lacking.empty()) {
      return message;
    }
    const std::size_t wanted = request->lacking.size();
    const std::size_t allowed = quotas_->TakeSegments(request->requester, wanted, now);
    metrics_.over_quota.segments += wanted - allowed;
    if (allowed == 0) return std::nullopt;
    exchange::SegmentRequest less = *request;
    less.lacking.resize(allowed, SegmentIndex(0));
    return less;
  }
  if (const auto* announced = std::get_if<exchange::RouteAnnouncement>(&message)) {
    if (announced->holder != announced->info.scout) return message;
    const auto allowed = RouteWithinQuotas(announced->info.scout, announced->info.key);
    if (allowed) return message;
    ++metrics_.over_quota.routes;
    keeper_->TellOverQuota(announced->info.key, allowed.error().message, now);
    return std::nullopt;
  }
  return message;
}

Result<void> Server::RouteWithinQuotas(const AgentId& scout, const route::RouteKey& key) {
  if (!quotas_->limits_routes()) return {};
  const auto stored = store_->FindRoute(key);
  if (!stored) return tl::unexpected(stored.error());
  return *stored ? Result<void>() : quotas_->TakeRoute(scout, key, steady_clock::now());
}

// A scout's first segments come before the route is announced.
exchange::SegmentBatch Server::WithinQuotas(const exchange::SegmentBatch& batch) {
  const auto now = steady_clock::now();
  exchange::SegmentBatch allowed{.sender = batch.sender, .pieces = {}, .trust = batch.trust};
  const std::size_t in_time = quotas_->TakeSegments(batch.sender, batch.pieces.size(), now);
  std::map<route::RouteKey, Result<void>> routes;
  for (const route::SegmentPiece& piece : batch.pieces) {
    const auto known = routes.find(piece.key);
    Result<void> room =
        known != routes.end() ? known->second : RouteWithinQuotas(batch.sender, piece.key);
    if (known == routes.end()) routes.emplace(piece.key, room);
    if (room && allowed.pieces.size() == in_time) {
      room = tl::unexpected(quotas_->TooManySegments(batch.sender));
    }
    if (room) room = quotas_->TakeBytes(batch.sender, piece.bytes.size(), now);
    if (room) {
      allowed.pieces.push_back(piece);
    } else {
      ++metrics_.over_quota.segments;
      keeper_->TellOverQuota(piece.key, room.error().message, now);
    }
  }
  return allowed;
}

}  // namespace trailcast::server
