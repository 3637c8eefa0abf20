#include "services/store/sqlite_store.h"

#include "services/base/hex.h"
#include "services/route/digest.h"
#include "services/route/labels.h"
#include "services/store/src/rows.h"

namespace trailcast::store {
namespace {

constexpr const char* kNewestFirst = "ORDER BY taught_unix_ms DESC, route DESC, teaching DESC";

constexpr const char* kUnreceipted =
    "AND number NOT IN (SELECT number FROM receipt WHERE route = ?1 AND teaching = ?2)";

using route::RouteInfo;
using route::RouteKey;
using route::SegmentPiece;

// Anything that is committed during its lifetime is on the disk, with everything that was committed
// before.
class AtOnce {
 public:
  AtOnce(SQLite::Database& db, SqliteOptions::Durability usual) : db_(db), usual_(usual) {
    if (usual_ != SqliteOptions::Durability::kAtOnce) db_.exec("PRAGMA synchronous = FULL");
  }
  ~AtOnce() {
    if (usual_ != SqliteOptions::Durability::kAtOnce) db_.tryExec("PRAGMA synchronous = NORMAL");
  }
  AtOnce(const AtOnce&) = delete;
  AtOnce& operator=(const AtOnce&) = delete;

 private:
  SQLite::Database& db_;
  SqliteOptions::Durability usual_;
};

template <typename Item>
Result<void> CheckAll(std::span<const Item> items, Result<void> (*check)(const Item&)) {
  for (const Item& item : items) {
    if (Result<void> possible = check(item); !possible) return possible;
  }
  return {};
}

}  // namespace

template <typename Item, typename Store>
Result<void> SqliteRouteStore::StoreAll(const std::string& doing, std::span<const Item> items,
                                        const Store& store) {
  return Guarded(doing, [&]() -> Result<void> {
    SQLite::Transaction transaction(*db_, SQLite::TransactionBehavior::IMMEDIATE);
    for (const Item& item : items) {
      if (Result<void> stored = store(item); !stored) return stored;
    }
    transaction.commit();
    return {};
  });
}

Result<void> SqliteRouteStore::PutRoutes(std::span<const RouteInfo> infos) {
  if (Result<void> possible = CheckAll(infos, &CheckRoute); !possible) return possible;
  if (infos.empty()) return {};
  const std::string doing =
      fmt::format("storing {} routes, {} first", infos.size(), Describe(infos.front().key));
  return Guarded(doing, [&]() -> Result<void> {
    const AtOnce at_once(*db_, durability_);
    return StoreAll(doing, infos, [&](const RouteInfo& info) { return PutNews(info); });
  });
}

Result<void> SqliteRouteStore::PutNews(const RouteInfo& info) {
  const Result<std::optional<RouteInfo>> known = FindRoute(info.key);
  if (!known && known.error().code != ErrorCode::kCorrupt) return tl::unexpected(known.error());
  RouteInfo after = info;
  if (known && known->has_value()) {
    Result<RouteInfo> merged = route::AfterNews(**known, info);
    if (!merged) return Wrap(merged.error(), "route store " + file_.path().string());
    if (*merged == **known) return {};
    after = std::move(*merged);
  }
  after.standing == route::Standing::kDeleted ? Bury(after) : Put(after);
  return {};
}

Result<void> SqliteRouteStore::AppendSegments(std::span<const SegmentPiece> pieces) {
  return AppendAll(pieces, [](const SegmentPiece&) {});
}

Result<void> SqliteRouteStore::AppendFetched(std::span<const SegmentPiece> pieces) {
  return AppendAll(pieces,
                   [this](const SegmentPiece& piece) { NoteReceipt(piece.key, piece.index); });
}

Result<void> SqliteRouteStore::AppendAll(std::span<const SegmentPiece> pieces,
                                         const std::function<void(const SegmentPiece&)>& then) {
  if (Result<void> whole = CheckAll(pieces, &CheckSegment); !whole) return whole;
  if (pieces.empty()) return {};
  const RouteKey* living = nullptr;  // a scout's pieces come one after the other
  return StoreAll(
      fmt::format("storing {} segments of {}", pieces.size(), Describe(pieces.front().key)), pieces,
      [&](const SegmentPiece& piece) -> Result<void> {
        if (living == nullptr || *living != piece.key) {
          if (auto possible = RefuseBuried(piece.key); !possible) return possible;
          living = &piece.key;
        }
        if (auto appended = Append(piece); !appended) return appended;
        then(piece);
        return {};
      });
}

Result<void> SqliteRouteStore::RefuseBuried(const RouteKey& key) {
  auto select = compiled_.Take("SELECT 1 FROM tombstone WHERE route = ? AND teaching = ?");
  BindKey(*select, key);
  if (!select->executeStep()) return {};
  return Fail(ErrorCode::kConflict, "route store {}: {} was deleted and takes no segments",
              file_.path().string(), Describe(key));
}

// A piece is nearly always new, so held ones are read only if the database reports a conflict.
Result<void> SqliteRouteStore::Append(const SegmentPiece& piece) {
  static const std::string insert =
      "INSERT INTO segment (route, teaching, number, digest, seal, bytes) VALUES (?,?,?,?,?,?) "
      "ON CONFLICT DO ";
  static const std::string insert_new = insert + "NOTHING";
  static const std::string replace =
      insert + "UPDATE SET digest = excluded.digest, seal = excluded.seal, bytes = excluded.bytes";
  const auto content = FindContent(piece.digest);
  if (!content) return tl::unexpected(content.error());
  const SegmentPiece relying{piece.key, piece.index, piece.digest, {}};
  if (Execute(insert_new, *content ? relying : piece)) return {};
  const Result<SegmentPiece> held = ReadSegment(piece.key, piece.index);
  if (!held && held.error().code == ErrorCode::kCorrupt) {
    // The bytes are written too, because the ones that were found may have been its own.
    Execute(replace, piece);
    return {};
  }
  if (!held) return tl::unexpected(held.error());
  if (held->digest == piece.digest) return {};
  return Fail(ErrorCode::kConflict,
              "route store {}: {} is held with other bytes (digest {:.12}.., given {:.12}..); "
              "two scouts may be teaching under one route id",
              file_.path().string(), Describe(piece.key, piece.index), ToHex(held->digest),
              ToHex(piece.digest));
}

bool SqliteRouteStore::Execute(const std::string& sql, const SegmentPiece& piece) {
  auto insert = compiled_.Take(sql);
  BindSegment(*insert, piece);
  return insert->exec() > 0;
}

Result<SegmentPiece> SqliteRouteStore::ReadSegment(const RouteKey& key, SegmentIndex index) {
  const auto doing = [&] { return "reading " + Describe(key, index); };
  return Guarded(doing, [&]() -> Result<SegmentPiece> {
    auto select = compiled_.Take(
        "SELECT digest, seal, bytes FROM segment WHERE route = ? AND teaching = ? AND number = ?");
    BindKey(*select, key);
    select->bind(3, index.value());
    if (!select->executeStep()) {
      return Fail(ErrorCode::kNotFound, "route store {} has no {}", file_.path().string(),
                  Describe(key, index));
    }
    Result<SegmentPiece> piece = ReadSegmentRow(*select, key, index);
    if (!piece) return Wrap(piece.error(), "route store " + file_.path().string());
    if (piece->bytes.empty()) {
      auto content = FindContent(piece->digest);
      if (!content) return tl::unexpected(content.error());
      if (*content) piece->bytes = std::move(**content);
    }
    if (Result<void> whole = route::CheckDigest(*piece); !whole) {
      return Wrap(whole.error(), "route store " + file_.path().string());
    }
    return piece;
  });
}

Result<std::vector<HeldSegment>> SqliteRouteStore::SegmentDigests(const RouteKey& key) {
  return Guarded(
      "listing the segments of " + Describe(key), [&]() -> Result<std::vector<HeldSegment>> {
        SQLite::Statement select(*db_,
                                 "SELECT digest, seal, NULL, number FROM segment WHERE route = ? "
                                 "AND teaching = ? ORDER BY number");
        BindKey(select, key);
        std::vector<HeldSegment> held;
        while (select.executeStep()) {
          const SegmentIndex index(select.getColumn(3).getUInt());
          const Result<SegmentPiece> named = ReadSegmentRow(select, key, index);
          if (named) held.push_back({index, named->digest});
        }
        return held;
      });
}

Result<std::optional<route::Bytes>> SqliteRouteStore::FindContent(const route::Digest& digest) {
  return Guarded("looking up a segment's bytes", [&]() -> Result<std::optional<route::Bytes>> {
    static const std::string sql =
        fmt::format("SELECT bytes FROM segment WHERE {} AND bytes IS NOT NULL", kOfDigest);
    auto select = compiled_.Take(sql);
    BindDigest(*select, 1, digest);
    while (select->executeStep()) {
      const SQLite::Column column = select->getColumn(0);
      const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
      const std::span whole(bytes, static_cast<std::size_t>(column.getBytes()));
      if (route::Sha256(whole) == digest) return route::Bytes(whole.begin(), whole.end());
    }
    return std::nullopt;
  });
}

Result<std::vector<SegmentIndex>> SqliteRouteStore::SelectIndices(const RouteKey& key,
                                                                  bool unreceipted) {
  return Guarded("listing the segments of " + Describe(key),
                 [&]() -> Result<std::vector<SegmentIndex>> {
                   SQLite::Statement select(
                       *db_, fmt::format("SELECT number FROM segment WHERE route = ?1 AND "
                                         "teaching = ?2 {} ORDER BY number",
                                         unreceipted ? kUnreceipted : ""));
                   BindKey(select, key);
                   std::vector<SegmentIndex> indices;
                   while (select.executeStep()) {
                     indices.emplace_back(select.getColumn(0).getUInt());
                   }
                   return indices;
                 });
}

Result<std::vector<SegmentIndex>> SqliteRouteStore::HeldSegments(const RouteKey& key) {
  return SelectIndices(key, false);
}

Result<std::vector<SegmentIndex>> SqliteRouteStore::UnreceiptedSegments(const RouteKey& key) {
  return SelectIndices(key, true);
}

Result<std::vector<RouteInfo>> SqliteRouteStore::SelectRoutes(
    const std::string& table, const std::string& where,
    const std::function<void(SQLite::Statement&)>& bind) {
  return Guarded("looking up routes", [&]() -> Result<std::vector<RouteInfo>> {
    auto select = compiled_.Take(fmt::format("SELECT {} FROM {} {}", kRouteColumns, table, where));
    bind(*select);
    std::vector<RouteInfo> routes;
    while (select->executeStep()) {
      Result<RouteInfo> info = ReadRoute(*select);
      if (!info) return Wrap(info.error(), "route store " + file_.path().string());
      routes.push_back(std::move(*info));
    }
    return routes;
  });
}

Result<std::optional<RouteInfo>> SqliteRouteStore::FindRoute(const RouteKey& key) {
  for (const char* table : {"route", "tombstone"}) {
    Result<std::vector<RouteInfo>> found =
        SelectRoutes(table, "WHERE route = ? AND teaching = ?",
                     [&](SQLite::Statement& select) { BindKey(select, key); });
    if (!found) return tl::unexpected(found.error());
    if (!found->empty()) return std::move(found->front());
  }
  return std::nullopt;
}

Result<std::vector<RouteInfo>> SqliteRouteStore::FindRevisions(const RouteId& route) {
  return SelectRoutes("route", "WHERE route = ? ORDER BY revision, teaching",
                      [&](SQLite::Statement& select) { select.bind(1, route.value()); });
}

Result<std::vector<KnownTeaching>> SqliteRouteStore::FindTeachings(const RouteId& route) {
  return Guarded("listing the teachings of a route", [&]() -> Result<std::vector<KnownTeaching>> {
    auto select = compiled_.Take(
        "SELECT teaching, revision, grown_unix_ms FROM route WHERE route = ?1 UNION ALL "
        "SELECT teaching, revision, grown_unix_ms FROM tombstone WHERE route = ?1");
    select->bind(1, route.value());
    std::vector<KnownTeaching> known;
    while (select->executeStep()) {
      known.push_back({TeachingOf(select->getColumn(0)),
                       RevisionNumber(select->getColumn(1).getUInt()),
                       select->getColumn(2).getInt64()});
    }
    return known;
  });
}

Result<std::vector<RouteInfo>> SqliteRouteStore::FindRoutesWithin(const std::string& id_prefix) {
  return Guarded("looking up routes by id", [&]() -> Result<std::vector<RouteInfo>> {
    static const std::string where = " WHERE route >= ?1 AND route < ?2 ";
    static const std::string sql = fmt::format(
        "SELECT {0} FROM route{1}UNION ALL SELECT {0} FROM tombstone{1}ORDER BY route, teaching",
        kRouteColumns, where);
    auto select = compiled_.Take(sql);
    select->bind(1, id_prefix);
    select->bind(2, id_prefix + kAfterHexDigits);
    std::vector<RouteInfo> found;
    while (select->executeStep()) {
      if (auto info = ReadRoute(*select)) found.push_back(std::move(*info));
    }
    return found;
  });
}

Result<std::vector<RouteInfo>> SqliteRouteStore::ListRoutes() {
  return SelectRoutes("route", kNewestFirst, [](SQLite::Statement&) {});
}

Result<std::vector<RouteInfo>> SqliteRouteStore::FindRoutesByName(const std::string& name) {
  return SelectRoutes("route", std::string("WHERE name = ? ") + kNewestFirst,
                      [&](SQLite::Statement& select) { select.bind(1, name); });
}

Result<void> SqliteRouteStore::MarkReceipted(const RouteKey& key,
                                             std::span<const SegmentIndex> indices) {
  if (indices.empty()) return {};
  return Guarded("noting receipts of " + Describe(key), [&]() -> Result<void> {
    SQLite::Transaction transaction(*db_, SQLite::TransactionBehavior::IMMEDIATE);
    for (const SegmentIndex index : indices) NoteReceipt(key, index);
    transaction.commit();
    return {};
  });
}

void SqliteRouteStore::NoteReceipt(const RouteKey& key, SegmentIndex index) {
  auto insert = compiled_.Take(
      "INSERT OR IGNORE INTO receipt SELECT route, teaching, number FROM segment WHERE "
      "route = ? AND teaching = ? AND number = ?");
  BindKey(*insert, key);
  insert->bind(3, index.value());
  insert->exec();
}

Result<std::unique_ptr<RouteStore>> OpenSqliteStore(const std::filesystem::path& file,
                                                    const SqliteOptions& options) {
  Result<StoreFile> locked = StoreFile::Acquire(file);
  if (!locked) return tl::unexpected(locked.error());
  auto db = OpenDatabase(file, options);
  if (!db) return tl::unexpected(db.error());
  return std::make_unique<SqliteRouteStore>(std::move(*locked), std::move(*db), options.durability);
}

Result<std::unique_ptr<RouteStore>> OpenExistingSqliteStore(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) return OpenSqliteStore(file);
  return Fail(ErrorCode::kNotFound, "there is no route store {}", file.string());
}

}  // namespace trailcast::store
