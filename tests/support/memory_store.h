#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "services/route/labels.h"
#include "services/store/route_store.h"
#include "tests/support/pieces.h"

namespace trailcast::test {

// This is a RouteStore whose "disk" is memory that outlives its user, with a switch for a full
// disk. Pieces are checked by ToyDigest.
class MemoryStore : public store::RouteStore {
 public:
  bool full = false;
  std::set<std::pair<route::RouteKey, SegmentIndex>> damaged;  // read as kCorrupt until replaced
  std::map<route::RouteKey, std::int64_t> grown_unix_ms;       // as tests set it
  int commits = 0;        // AppendSegments that stored something
  int route_commits = 0;  // PutRoutes that did

  Result<void> PutRoutes(std::span<const route::RouteInfo> infos) override {
    if (full) return Fail(ErrorCode::kUnavailable, "disk full");
    std::map<route::RouteKey, route::RouteInfo> after = routes_;
    for (const route::RouteInfo& info : infos) {
      const auto [at, is_new] = after.try_emplace(info.key, info);
      if (is_new) continue;
      auto merged = route::AfterNews(at->second, info);
      if (!merged) return tl::unexpected(merged.error());
      at->second = std::move(*merged);
    }
    routes_ = std::move(after);
    std::erase_if(segments_, [&](const auto& entry) { return IsDeleted(entry.first.first); });
    ++route_commits;
    return {};
  }

  Result<void> AppendSegments(std::span<const route::SegmentPiece> pieces) override {
    if (full) return Fail(ErrorCode::kUnavailable, "disk full");
    for (const route::SegmentPiece& piece : pieces) {
      if (auto ok = ToyIntegrity().check_piece(piece); !ok) return ok;
      if (IsDeleted(piece.key)) return Fail(ErrorCode::kConflict, "route was deleted");
      const auto held = segments_.find({piece.key, piece.index});
      if (held != segments_.end() && held->second.digest != piece.digest) {
        return Fail(ErrorCode::kConflict, "segment {} is held with another digest",
                    piece.index.value());
      }
    }
    for (const route::SegmentPiece& piece : pieces) {
      segments_.emplace(std::pair(piece.key, piece.index), piece);
      damaged.erase({piece.key, piece.index});
    }
    ++commits;
    return {};
  }

  Result<void> DropSegments(const route::RouteKey& key) override {
    std::erase_if(segments_, [&](const auto& entry) { return entry.first.first == key; });
    return {};
  }

  Result<route::SegmentPiece> ReadSegment(const route::RouteKey& key, SegmentIndex index) override {
    const auto found = segments_.find({key, index});
    if (found == segments_.end()) {
      return Fail(ErrorCode::kNotFound, "segment {} is not held", index.value());
    }
    if (damaged.contains({key, index})) {
      return Fail(ErrorCode::kCorrupt, "segment {} is damaged", index.value());
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

  Result<std::vector<store::HeldSegment>> SegmentDigests(const route::RouteKey& key) override {
    std::vector<store::HeldSegment> held;
    for (const auto& [where, piece] : segments_) {
      if (where.first == key) held.push_back({where.second, piece.digest});
    }
    return held;
  }

  Result<std::vector<store::HeldTeaching>> ListHeld(const route::RouteKey& after,
                                                    std::size_t most) override {
    std::map<route::RouteKey, store::HeldTeaching> held;
    for (const auto& [where, piece] : segments_) {
      if (where.first <= after) continue;
      store::HeldTeaching& teaching = held[where.first];
      teaching.key = where.first;
      teaching.known = routes_.contains(where.first);
      ++teaching.segments;
    }
    std::vector<store::HeldTeaching> first;
    for (const auto& [key, teaching] : held) {
      if (first.size() < most) first.push_back(teaching);
    }
    return first;
  }

  Result<std::optional<route::Bytes>> FindContent(const route::Digest& digest) override {
    for (const auto& [where, piece] : segments_) {
      if (piece.digest == digest) return piece.bytes;
    }
    return std::nullopt;
  }

  Result<std::optional<route::RouteInfo>> FindRoute(const route::RouteKey& key) override {
    const auto found = routes_.find(key);
    if (found == routes_.end()) return std::nullopt;
    return found->second;
  }

  Result<std::vector<route::RouteInfo>> FindRevisions(const RouteId& route) override {
    return Living([&](const route::RouteInfo& info) { return info.key.route == route; });
  }

  Result<std::vector<store::KnownTeaching>> FindTeachings(const RouteId& route) override {
    std::vector<store::KnownTeaching> known;
    for (const auto& [key, info] : routes_) {
      if (key.route == route) known.push_back({key.teaching, info.revision, grown_unix_ms[key]});
    }
    return known;
  }

  Result<std::vector<route::RouteInfo>> FindRoutesWithin(const std::string& id_prefix) override {
    std::vector<route::RouteInfo> found;
    for (const auto& [key, info] : routes_) {
      if (key.route.value().starts_with(id_prefix)) found.push_back(info);
    }
    return found;
  }

  Result<std::vector<route::RouteInfo>> ListRoutes() override {
    return Living([](const route::RouteInfo&) { return true; });
  }

  Result<std::vector<route::RouteInfo>> FindRoutesByName(const std::string& name) override {
    return Living([&](const route::RouteInfo& info) { return info.name == name; });
  }

  // Returns all in one page, by name or id only.
  Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) override {
    route::RoutePage page;
    page.routes = Living([&](const route::RouteInfo& info) {
      return query.name.empty() || route::IsMeantBy(info, query.name);
    });
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

  [[nodiscard]] bool shared() const override { return true; }  // keepers of one test share it

  Result<std::vector<std::string>> Verify() override { return std::vector<std::string>(); }

 private:
  using Where = std::pair<route::RouteKey, SegmentIndex>;

  [[nodiscard]] bool IsDeleted(const route::RouteKey& key) const {
    const auto found = routes_.find(key);
    return found != routes_.end() && found->second.standing == route::Standing::kDeleted;
  }

  // Returns routes sorted by key.
  template <typename Matches>
  [[nodiscard]] std::vector<route::RouteInfo> Living(const Matches& matches) const {
    std::vector<route::RouteInfo> infos;
    for (const auto& [key, info] : routes_) {
      if (!IsDeleted(key) && matches(info)) infos.push_back(info);
    }
    return infos;
  }

  std::map<route::RouteKey, route::RouteInfo> routes_;
  std::map<Where, route::SegmentPiece> segments_;
  std::set<Where> receipted_;
};

}  // namespace trailcast::test
