#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/store/route_store.h"
#include "tests/support/pieces.h"

namespace trailcast::test {

// A RouteStore whose "disk" is memory that outlives whoever uses it, with a switch for a full disk.
// Pieces are checked by ToyDigest.
class MemoryStore : public store::RouteStore {
 public:
  bool full = false;
  int commits = 0;        // AppendSegments that stored something
  int route_commits = 0;  // PutRoutes that did

  Result<void> PutRoutes(std::span<const route::RouteInfo> infos) override {
    if (full) return Fail(ErrorCode::kUnavailable, "disk full");
    for (const route::RouteInfo& info : infos) {
      const auto found = routes_.find(info.key);
      if (found != routes_.end() && found->second.state == route::RouteState::kComplete &&
          found->second != info) {
        return Fail(ErrorCode::kConflict, "route is complete");
      }
    }
    for (const route::RouteInfo& info : infos) {
      const auto [at, is_new] = routes_.try_emplace(info.key, info);
      if (!is_new && info.segment_count >= at->second.segment_count) at->second = info;
    }
    ++route_commits;
    return {};
  }

  Result<void> AppendSegments(std::span<const route::SegmentPiece> pieces) override {
    if (full) return Fail(ErrorCode::kUnavailable, "disk full");
    for (const route::SegmentPiece& piece : pieces) {
      if (auto ok = ToyIntegrity().check_piece(piece); !ok) return ok;
      const auto held = segments_.find({piece.key, piece.index});
      if (held != segments_.end() && held->second.digest != piece.digest) {
        return Fail(ErrorCode::kConflict, "segment {} is held with another digest",
                    piece.index.value());
      }
    }
    for (const route::SegmentPiece& piece : pieces) {
      segments_.emplace(std::pair(piece.key, piece.index), piece);
    }
    ++commits;
    return {};
  }

  Result<route::SegmentPiece> ReadSegment(const route::RouteKey& key, SegmentIndex index) override {
    const auto found = segments_.find({key, index});
    if (found == segments_.end()) {
      return Fail(ErrorCode::kNotFound, "segment {} is not held", index.value());
    }
    return found->second;
  }

  Result<std::vector<SegmentIndex>> HeldSegments(const route::RouteKey& key) override {
    std::vector<SegmentIndex> held;
    for (const auto& [where, piece] : segments_) {
      if (where.first == key) held.push_back(where.second);
    }
    return held;
  }

  Result<std::optional<route::RouteInfo>> FindRoute(const route::RouteKey& key) override {
    const auto found = routes_.find(key);
    if (found == routes_.end()) return std::nullopt;
    return found->second;
  }

  Result<std::vector<route::RouteInfo>> ListRoutes() override {
    std::vector<route::RouteInfo> infos;
    for (const auto& [key, info] : routes_) infos.push_back(info);
    return infos;
  }

  Result<std::vector<route::RouteInfo>> FindRoutesByName(const std::string& name) override {
    std::vector<route::RouteInfo> infos;
    for (const auto& [key, info] : routes_) {
      if (info.name == name) infos.push_back(info);
    }
    return infos;
  }

  // All in one page, by name only.
  Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) override {
    route::RoutePage page;
    page.routes = (query.name.empty() ? ListRoutes() : FindRoutesByName(query.name)).value();
    page.total = page.routes.size();
    return page;
  }

  Result<std::vector<std::string>> NamesNear(const std::string&, std::size_t) override {
    std::vector<std::string> names;
    for (const auto& [key, info] : routes_) names.push_back(info.name);
    return names;
  }

  Result<void> MarkReceipted(const route::RouteKey& key,
                             std::span<const SegmentIndex> indices) override {
    for (const SegmentIndex index : indices) receipted_.insert({key, index});
    return {};
  }

  Result<std::vector<SegmentIndex>> UnreceiptedSegments(const route::RouteKey& key) override {
    std::vector<SegmentIndex> unreceipted;
    for (const auto& [where, piece] : segments_) {
      if (where.first == key && !receipted_.contains(where)) unreceipted.push_back(where.second);
    }
    return unreceipted;
  }

  Result<std::vector<std::string>> Verify() override { return std::vector<std::string>(); }

 private:
  using Where = std::pair<route::RouteKey, SegmentIndex>;
  std::map<route::RouteKey, route::RouteInfo> routes_;
  std::map<Where, route::SegmentPiece> segments_;
  std::set<Where> receipted_;
};

}  // namespace trailcast::test
