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
  bool known = false;  // its description, with its route's name, is held as well
};

// Durable routes: their descriptions and their segments' bytes. One process opens a file for
// writing; several may share a database. It is not thread-safe. Every read of a segment checks its
// digest. Errors name the file or database.
class RouteStore {
 public:
  static constexpr std::uint32_t kMaxPage = 1000;

  virtual ~RouteStore() = default;
  RouteStore(const RouteStore&) = delete;
  RouteStore& operator=(const RouteStore&) = delete;

  // Stores all or nothing, on disk when this returns. It inserts a revision, or updates it as
  // route::AfterNews says: old news is ignored, and a complete revision changes only its labels
  // (kConflict otherwise). An info whose standing is kDeleted leaves a tombstone: the revision's
  // segments are deleted, later ones are refused, and only FindRoute still knows it.
  // kInvalidArgument names the field that no route can have.
  [[nodiscard]] virtual Result<void> PutRoutes(std::span<const route::RouteInfo> infos) = 0;
  [[nodiscard]] Result<void> PutRoute(const route::RouteInfo& info) {
    return PutRoutes({&info, 1});
  }

  // Stores all or nothing, on disk when this returns. Pieces that are held with the same digest are
  // fine. Errors: kConflict if a held index has another digest, or the revision was deleted;
  // kCorrupt if a piece's bytes do not match its digest; kUnavailable if the disk is full. The
  // route need not be known yet. A held piece that was damaged on disk is replaced by the given
  // one.
  [[nodiscard]] virtual Result<void> AppendSegments(
      std::span<const route::SegmentPiece> pieces) = 0;

  // Forgets all segments of a revision, but not its description. They may be stored again, with
  // other bytes too.
  [[nodiscard]] virtual Result<void> DropSegments(const route::RouteKey& key) = 0;

  // Appends segments that another agent has to deliver, so they count as acknowledged.
  [[nodiscard]] virtual Result<void> AppendFetched(std::span<const route::SegmentPiece> pieces) {
    if (auto appended = AppendSegments(pieces); !appended) return appended;
    for (const route::SegmentPiece& piece : pieces) {
      if (auto marked = MarkReceipted(piece.key, {&piece.index, 1}); !marked) return marked;
    }
    return {};
  }

  // Errors: kNotFound, or kCorrupt if the bytes on disk do not match their digest.
  [[nodiscard]] virtual Result<route::SegmentPiece> ReadSegment(const route::RouteKey& key,
                                                                SegmentIndex index) = 0;
  // Returns the held indices, rising.
  [[nodiscard]] virtual Result<std::vector<SegmentIndex>> HeldSegments(
      const route::RouteKey& key) = 0;
  // Returns them with their digests, except for those whose digest was lost to damage. Only reading
  // tells whether the bytes are still whole.
  [[nodiscard]] virtual Result<std::vector<HeldSegment>> SegmentDigests(
      const route::RouteKey& key) = 0;
  // Returns the first `most` teachings by key after `after` of which segments are held. The key
  // with an empty route id is before all.
  [[nodiscard]] virtual Result<std::vector<HeldTeaching>> ListHeld(const route::RouteKey& after,
                                                                   std::size_t most) = 0;
  // Returns whole bytes with this digest, of any route's segment, or nothing if none are held.
  [[nodiscard]] virtual Result<std::optional<route::Bytes>> FindContent(
      const route::Digest& digest) = 0;

  // Includes tombstones.
  [[nodiscard]] virtual Result<std::optional<route::RouteInfo>> FindRoute(
      const route::RouteKey& key) = 0;
  // Returns all teachings of a route that were not deleted, by revision.
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRevisions(
      const RouteId& route) = 0;
  // Returns all that were ever stored of it, including deleted ones.
  [[nodiscard]] virtual Result<std::vector<KnownTeaching>> FindTeachings(const RouteId& route) = 0;
  // Returns those whose route's id begins so, by key, including tombstones but not damaged ones.
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRoutesWithin(
      const std::string& id_prefix) = 0;
  // Returns the newest first (taught_unix_ms, then key).
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> ListRoutes() = 0;
  [[nodiscard]] virtual Result<std::vector<route::RouteInfo>> FindRoutesByName(
      const std::string& name) = 0;

  // Returns one page of at most kMaxPage matching routes. kInvalidArgument, naming the field, means
  // that no page, or one of another order, gave the cursor. The caller must check the query's other
  // fields.
  [[nodiscard]] virtual Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) = 0;
  // Returns all with this name, or with an id that begins so, the newest first.
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
  // Returns names in use, each once: the `count` nearest in the alphabet on either side, beginning
  // with `name` if it is one.
  [[nodiscard]] virtual Result<std::vector<std::string>> NamesNear(const std::string& name,
                                                                   std::size_t count) = 0;

  // These keep the scout's records of segments that some server has acknowledged, and of those that
  // none has.
  [[nodiscard]] virtual Result<void> MarkReceipted(const route::RouteKey& key,
                                                   std::span<const SegmentIndex> indices) = 0;
  [[nodiscard]] virtual Result<std::vector<SegmentIndex>> UnreceiptedSegments(
      const route::RouteKey& key) = 0;

  // kUnavailable means that nothing can be read or written at present, as when a database is away.
  // The call is cheap; a file is there as long as it is open.
  [[nodiscard]] virtual Result<void> CheckReachable() { return {}; }

  // Says whether other processes write to it, too, so that values read earlier may have changed.
  [[nodiscard]] virtual bool shared() const { return false; }
  // Runs `work`, which reads and writes this store. If several processes share the store, no
  // other's Exclusively interferes, everything is written when this returns, all or nothing, and
  // `work` may be run again after interference. With a store of one process it is just run.
  [[nodiscard]] virtual Result<void> Exclusively(const std::function<Result<void>()>& work) {
    return work();
  }
  // Returns the answer to an operator's request, whichever process gave it, so that the request is
  // carried out once. Answers are remembered for an hour, or (if no other process shares the store)
  // among the last 64.
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

  // Returns one line for each damaged segment or route; empty if everything is whole.
  [[nodiscard]] virtual Result<std::vector<std::string>> Verify() = 0;

 protected:
  RouteStore() = default;

 private:
  std::deque<std::pair<std::string, std::string>> answers_;  // with their requests, the oldest
                                                             // first
};

struct SqliteOptions {
  // When appended segments are on the disk: when AppendSegments returns, or when the next PutRoutes
  // does, so that nothing is missing from a complete route. The latter is for copies of what others
  // hold: a power cut may cost the last of them, but nothing that was there before.
  enum class Durability : std::uint8_t { kAtOnce, kWithRoutes };
  Durability durability = Durability::kAtOnce;
  // The bound of the file's size in bytes; 0 for none. The log beside it takes some 4 MiB more.
  // Appending beyond the bound is kUnavailable; nothing held is lost.
  std::uint64_t max_bytes = 0;
};

// Opens or creates a store; the folder must exist. Errors: kCorrupt if the file is no store or is
// cut short (it is left untouched), kConflict if another process has it open, kUnavailable if it
// cannot be written. It takes milliseconds: reading finds damage inside, and Verify() finds all of
// it.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenSqliteStore(
    const std::filesystem::path& file, const SqliteOptions& options = {});
// Opens a store that must exist, so that a mistyped name makes none. kNotFound means that it does
// not.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenExistingSqliteStore(
    const std::filesystem::path& file);

struct PostgresOptions {
  bool read_only = false;  // nothing is written, and the tables must exist
  // A database that has not answered for so long is taken for lost. This exceeds the 30 s after
  // which a live PostgreSQL ends a statement itself.
  std::chrono::milliseconds patience{35'000};
};

// Opens `url`, as postgresql://user@host:port/database; its tables are made if there are none.
// Errors: kInvalidArgument if that is no such URL (or the password, the database, a right or the
// version is wrong), kUnavailable if it cannot be reached. A connection that is lost later is made
// again; until then, everything is kUnavailable. No message has the password.
[[nodiscard]] Result<std::unique_ptr<RouteStore>> OpenPostgresStore(
    const std::string& url, const PostgresOptions& options = {});

}  // namespace trailcast::store
