#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "services/route/route.h"
#include "services/route/route_query.h"
#include "services/route/route_ref.h"

namespace trailcast::store {

struct HeldSegment {
  SegmentIndex index;
  route::Digest digest{};
};

struct KnownTeaching {
  TeachingId teaching;
  RevisionNumber revision;
  // When a segment of it, or its end, was last stored here, by this machine's clock.
  std::int64_t grown_unix_ms = 0;
};

// A teaching of which segments are held.
struct HeldTeaching {
  route::RouteKey key;
  std::uint64_t segments = 0;
  bool known = false;  // what is known of it, its route's name and all, is held too
};

// Durable routes: their infos and their segments' bytes. One process opens a file for writing,
// several may share a database; not thread-safe. Every read of a segment checks its digest. Errors
// name the file or database.
class RouteStore {
 public:
  static constexpr std::uint32_t kMaxPage = 1000;

  virtual ~RouteStore() = default;
  RouteStore(const RouteStore&) = delete;
  RouteStore& operator=(const RouteStore&) = delete;

  // All or nothing, on disk when this returns.
  // Inserts, or brings what is known of the same key up to date as route::AfterNews says: old news
  // is ignored, a complete revision changes its labels only (kConflict otherwise). An info whose
  // standing is kDeleted leaves a tombstone: the revision's segments go, later ones are refused,
  // and only FindRoute still knows of it. kInvalidArgument, naming the field, for what no route can
  // be.
  [[nodiscard]] virtual Result<void> PutRoutes(std::span<const route::RouteInfo> infos) = 0;
  [[nodiscard]] Result<void> PutRoute(const route::RouteInfo& info) {
    return PutRoutes({&info, 1});
  }

  // All or nothing, on disk when this returns. Pieces already held with the same digest are fine;
  // kConflict if a held index has another digest, or the revision was deleted; kCorrupt if a
  // piece's bytes fail its digest;
  // kUnavailable when the disk is full. The route need not be known yet. A held piece that has
  // become damaged on disk is replaced by the one given.
  [[nodiscard]] virtual Result<void> AppendSegments(
      std::span<const route::SegmentPiece> pieces) = 0;

  // Forgets all segments of a revision, not what is known of it; they may be stored again, with
  // other bytes too.
  [[nodiscard]] virtual Result<void> DropSegments(const route::RouteKey& key) = 0;

  // The same of what another agent is to deliver: counts as receipted.
  [[nodiscard]] virtual Result<void> AppendFetched(std::span<const route::SegmentPiece> pieces) {
    if (auto appended = AppendSegments(pieces); !appended) return appended;
    for (const route::SegmentPiece& piece : pieces) {
      if (auto marked = MarkReceipted(piece.key, {&piece.index, 1}); !marked) return marked;
    }
    return {};
  }

  // kNotFound, or kCorrupt when the bytes on disk fail their digest.
  [[nodiscard]] virtual Result<route::SegmentPiece> ReadSegment(const route::RouteKey& key,
                                                                SegmentIndex index) = 0;
  // Indices held, rising.
  [[nodiscard]] virtual Result<std::vector<SegmentIndex>> HeldSegments(
      const route::RouteKey& key) = 0;
  // The same with their digests; those of which nobody can say it any more, for the damage, are
  // left out. That the bytes are still whole only reading them tells.
  [[nodiscard]] virtual Result<std::vector<HeldSegment>> SegmentDigests(
      const route::RouteKey& key) = 0;
  // Teachings of which segments are held, by key: the first `most` after this one. None is before
  // the one of an empty route id.
  [[nodiscard]] virtual Result<std::vector<HeldTeaching>> ListHeld(const route::RouteKey& after,
                                                                   std::size_t most) = 0;
  // Bytes with this digest, whole, whichever route's segment they are; nothing if none are held.
  [[nodiscard]] virtual Result<std::optional<route::Bytes>> FindContent(
      const route::Digest& digest) = 0;

  // Tombstones included.
  [[nodiscard]] virtual Result<std::optional<route::RouteInfo>> FindRoute(
      const route::RouteKey& key) = 0;
  // All teachings of a route that were not deleted, by revision.
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRevisions(
      const RouteId& route) = 0;
  // All that were ever stored of it, the deleted ones too.
  [[nodiscard]] virtual Result<std::vector<KnownTeaching>> FindTeachings(const RouteId& route) = 0;
  // Those whose route's id begins so, by key; tombstones included, those that are damaged not.
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRoutesWithin(
      const std::string& id_prefix) = 0;
  // Newest first (taught_unix_ms, then key).
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> ListRoutes() = 0;
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRoutesByName(
      const std::string& name) = 0;

  // One page of the routes that match; at most kMaxPage of them. kInvalidArgument, naming the
  // field, for a cursor that no page gave, or that another order did. What the query's other fields
  // may hold is the caller's to check.
  [[nodiscard]] virtual Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) = 0;
  // All that have this name, or an id that begins so; newest first.
  [[nodiscard]] Result<std::vector<route::RouteInfo>> FindMeant(const std::string& name_or_id) {
    std::vector<route::RouteInfo> found;
    route::RouteQuery query{.name = name_or_id};
    do {
      auto page = QueryRoutes(query);
      if (!page) return tl::unexpected(page.error());
      found.insert(found.end(), page->routes.begin(), page->routes.end());
      query.cursor = page->next;
    } while (!query.cursor.empty());
    return route::OnlyMeant(std::move(found), name_or_id);
  }
  // Names in use, each once: the `count` nearest in the alphabet on either side, `name` first if it
  // is one.
  [[nodiscard]] virtual Result<std::vector<std::string>> NamesNear(const std::string& name,
                                                                   std::size_t count) = 0;

  // The scout's book-keeping: segments that some server has confirmed, and those none has.
  [[nodiscard]] virtual Result<void> MarkReceipted(const route::RouteKey& key,
                                                   std::span<const SegmentIndex> indices) = 0;
  [[nodiscard]] virtual Result<std::vector<SegmentIndex>> UnreceiptedSegments(
      const route::RouteKey& key) = 0;

  // kUnavailable while nothing can be read or written, as when a database is away. Cheap; a file is
  // there as long as it is open.
  [[nodiscard]] virtual Result<void> CheckReachable() { return {}; }

  // Whether other processes write to it, too: what was read once may have changed since.
  [[nodiscard]] virtual bool shared() const { return false; }
  // Runs `work`, which reads and writes this store. Where several processes share it, no other's
  // Exclusively comes between, what is written is there when this returns, all or nothing, and
  // `work` may be run again when something else did. With a store of one process it is just run.
  [[nodiscard]] virtual Result<void> Exclusively(const std::function<Result<void>()>& work) {
    return work();
  }
  // What an operator's request was answered with, by whichever process: it is carried out once.
  // Remembered for an hour, or (where no other process shares the store) among the last 64.
  [[nodiscard]] virtual Result<std::optional<std::string>> FindAnswer(const std::string& request) {
    const auto found = std::find_if(answers_.begin(), answers_.end(),
                                    [&](const auto& each) { return each.first == request; });
    if (found == answers_.end()) return std::nullopt;
    return found->second;
  }
  [[nodiscard]] virtual Result<void> RememberAnswer(const std::string& request,
                                                    const std::string& answer) {
    constexpr std::size_t kRemembered = 64;
    answers_.emplace_back(request, answer);
    if (answers_.size() > kRemembered) answers_.pop_front();
    return {};
  }

  // What would be read wrong: one line per damaged segment or route. Empty when all is whole.
  [[nodiscard]] virtual Result<std::vector<std::string>> Verify() = 0;

 protected:
  RouteStore() = default;

 private:
  std::deque<std::pair<std::string, std::string>> answers_;  // with their requests, oldest first
};

struct SqliteOptions {
  // When appended segments are on the disk: when AppendSegments returns, or when the next PutRoutes
  // does, so that of what is stored as complete nothing is missing. The latter is for copies of
  // what others hold: a power cut may cost the last of them, and nothing that was there before.
  enum class Durability : std::uint8_t { kAtOnce, kWithRoutes };
  Durability durability = Durability::kAtOnce;
  // How large the file may grow, in bytes; 0 is as large as the disk. The log beside it comes on
  // top, some 4 MiB. Appending beyond gives kUnavailable; nothing held is lost.
  std::uint64_t max_bytes = 0;
};

// Opens or creates; the folder must exist. kCorrupt when the file is not a store or is cut short
// (it is left untouched), kConflict when another process has it open, kUnavailable when it cannot
// be written. Takes milliseconds: damage inside is found by reading, and all of it by Verify().
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenSqliteStore(
    const std::filesystem::path& file, const SqliteOptions& options = {});
// The same of a store that is to be there: a mistyped name makes none. kNotFound: it is not.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenExistingSqliteStore(
    const std::filesystem::path& file);

struct PostgresOptions {
  bool read_only = false;  // nothing is written, the tables must be there
  // A database that has not answered for so long is taken for lost. Above the 30 s after which a
  // PostgreSQL that is alive ends a statement itself.
  std::chrono::milliseconds patience{35'000};
};

// `url` as postgresql://user@host:port/database; its tables are made where there are none.
// kInvalidArgument when that is not one (or the password, the database, a right or the version is
// wrong), kUnavailable when it cannot be reached. A connection that is lost later is made anew;
// until it is there, everything is kUnavailable. No message has the password.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenPostgresStore(
    const std::string& url, const PostgresOptions& options = {});

}  // namespace trailcast::store
