// This part of PostgresRouteStore stores and reads segments.
#include "services/store/src/postgres/postgres_store.h"

#include <algorithm>

#include "services/base/hex.h"
#include "services/route/digest.h"
#include "services/store/src/postgres/postgres_rows.h"
#include "services/store/src/row_values.h"

namespace trailcast::store {
namespace {

// It jumps from one key to the next: of a hundred thousand segments of one teaching it looks only
// at the first.
constexpr const char* kListHeld = R"(
WITH RECURSIVE held AS (
  (SELECT route, teaching, 1 AS number FROM segment WHERE (route, teaching) > (?, ?)
   ORDER BY route, teaching LIMIT 1)
  UNION ALL
  SELECT next.route, next.teaching, held.number + 1 FROM held, LATERAL (
    SELECT route, teaching FROM segment WHERE (route, teaching) > (held.route, held.teaching)
    ORDER BY route, teaching LIMIT 1) AS next
  WHERE held.number < ?)
SELECT route, teaching,
  (SELECT count(*) FROM segment WHERE (segment.route, segment.teaching) = (held.route, held.teaching)),
  EXISTS (SELECT FROM route WHERE (route.route, route.teaching) = (held.route, held.teaching))
FROM held ORDER BY number
)";

using route::RouteKey;
using route::SegmentPiece;

// Pieces are sorted, because two processes that lock the same rows must do so in the same order.
using Pieces = std::map<std::pair<RouteKey, SegmentIndex>, const SegmentPiece*>;

void InsertContents(pqxx::transaction_base& transaction, const Pieces& pieces) {
  std::map<route::Digest, const SegmentPiece*> contents;
  for (const auto& [where, piece] : pieces) contents.emplace(piece->digest, piece);
  ForSome(contents, [&](auto begin, auto end) {
    PostgresValues values;
    for (auto each = begin; each != end; ++each) {
      values.Add(each->first);
      values.AddBytes(each->second->bytes.data(), each->second->bytes.size());
    }
    // A content that is held is written again only if it is damaged.
    (void)values.Execute(transaction,
                         "INSERT INTO content (digest, bytes) VALUES " + values.Rows(2) +
                             " ON CONFLICT (digest) DO UPDATE SET bytes = excluded.bytes "
                             "WHERE content.bytes <> excluded.bytes");
  });
}

void InsertSegments(pqxx::transaction_base& transaction, const Pieces& pieces) {
  ForSome(pieces, [&](auto begin, auto end) {
    PostgresValues values;
    for (auto each = begin; each != end; ++each) values.AddSegment(*each->second);
    (void)values.Execute(transaction,
                         "INSERT INTO segment (route, teaching, number, digest, seal) VALUES " +
                             values.Rows(5) +
                             " ON CONFLICT (route, teaching, number) DO UPDATE "
                             "SET digest = excluded.digest, seal = excluded.seal");
  });
}

}  // namespace

void PostgresRouteStore::Lock(Transaction& transaction, const Keys& keys) {
  ForSome(keys, [&](auto begin, auto end) {
    PostgresValues values;
    std::for_each(begin, end, [&](const RouteKey& key) { values.Add(key); });
    const std::string rows = values.Rows(2);
    (void)values.Execute(transaction, "INSERT INTO teaching (route, teaching) VALUES " + rows +
                                          " ON CONFLICT DO NOTHING");
    (void)values.Execute(transaction, "SELECT FROM teaching WHERE (route, teaching) IN (" + rows +
                                          ") ORDER BY route, teaching FOR UPDATE");
  });
}

Result<void> PostgresRouteStore::AppendSegments(std::span<const SegmentPiece> pieces) {
  for (const SegmentPiece& piece : pieces) {
    if (Result<void> possible = CheckSegment(piece); !possible) return possible;
  }
  if (pieces.empty()) return {};
  return session_->Run(
      Kind::kWrite,
      fmt::format("storing {} segments of {}", pieces.size(), Describe(pieces.front().key)),
      [&](Transaction& transaction) { return Append(transaction, pieces); });
}

Result<void> PostgresRouteStore::Append(Transaction& transaction,
                                        std::span<const SegmentPiece> pieces) {
  Keys keys;
  for (const SegmentPiece& piece : pieces) keys.insert(piece.key);
  Lock(transaction, keys);
  if (auto living = RefuseBuried(transaction, keys); !living) return living;
  Digests held = FindHeld(transaction, pieces);
  Pieces lacking;
  for (const SegmentPiece& piece : pieces) {
    const auto [at, is_new] = held.try_emplace({piece.key, piece.index}, piece.digest);
    if (is_new) lacking.emplace(at->first, &piece);
    if (at->second != piece.digest) return Conflict(piece, at->second);
  }
  InsertContents(transaction, lacking);
  InsertSegments(transaction, lacking);
  return {};
}

Result<void> PostgresRouteStore::RefuseBuried(Transaction& transaction, const Keys& keys) const {
  std::optional<RouteKey> buried;
  ForSome(keys, [&](auto begin, auto end) {
    PostgresValues values;
    std::for_each(begin, end, [&](const RouteKey& key) { values.Add(key); });
    const pqxx::result rows = values.Execute(
        transaction, "SELECT route, teaching FROM tombstone WHERE (route, teaching) IN (" +
                         values.Rows(2) + ") LIMIT 1");
    if (!rows.empty()) buried = ReadKey(rows[0]);
  });
  if (!buried) return {};
  return Fail(ErrorCode::kConflict, "route store {}: {} was deleted and takes no segments",
              session_->name(), Describe(*buried));
}

PostgresRouteStore::Digests PostgresRouteStore::FindHeld(Transaction& transaction,
                                                         std::span<const SegmentPiece> pieces) {
  Digests held;
  ForSome(pieces, [&](auto begin, auto end) {
    PostgresValues values;
    for (auto piece = begin; piece != end; ++piece) {
      values.Add(piece->key);
      values.Add(std::int64_t{piece->index.value()});
    }
    const pqxx::result rows = values.Execute(
        transaction,
        "SELECT route, teaching, number, digest, seal, bytes FROM segment LEFT JOIN content USING "
        "(digest) WHERE (route, teaching, number) IN (" +
            values.Rows(3) + ")");
    for (const pqxx::row& row : rows) {
      const RouteKey key = ReadKey(row);
      const SegmentIndex index(row[2].as<std::uint32_t>());
      if (const auto whole = ReadSegmentRow(row, key, index)) {
        held.try_emplace({key, index}, whole->digest);
      }
    }
  });
  return held;
}

Result<void> PostgresRouteStore::Conflict(const SegmentPiece& piece,
                                          const route::Digest& held) const {
  return Fail(ErrorCode::kConflict,
              "route store {}: {} is held with other bytes (digest {:.12}.., given {:.12}..); "
              "two scouts may be teaching under one route id",
              session_->name(), Describe(piece.key, piece.index), ToHex(held), ToHex(piece.digest));
}

Result<SegmentPiece> PostgresRouteStore::ReadSegment(const RouteKey& key, SegmentIndex index) {
  const std::string which = Describe(key, index);
  return session_->Run(
      Kind::kRead, "reading " + which, [&](Transaction& transaction) -> Result<SegmentPiece> {
        PostgresValues values;
        values.Add(key);
        values.Add(std::int64_t{index.value()});
        const pqxx::result rows = values.Execute(
            transaction,
            "SELECT digest, seal, bytes FROM segment LEFT JOIN content USING (digest) WHERE "
            "route = ? AND teaching = ? AND number = ?");
        if (rows.empty()) {
          return Fail(ErrorCode::kNotFound, "route store {} has no {}", session_->name(), which);
        }
        Result<SegmentPiece> piece = ReadSegmentRow(rows[0], key, index);
        if (!piece) return Wrap(piece.error(), "route store " + session_->name());
        return piece;
      });
}

Result<std::vector<HeldSegment>> PostgresRouteStore::SegmentDigests(const RouteKey& key) {
  return session_->Run(Kind::kRead, "listing the segments of " + Describe(key),
                       [&](Transaction& transaction) -> Result<std::vector<HeldSegment>> {
                         PostgresValues values;
                         values.Add(key);
                         std::vector<HeldSegment> held;
                         for (const pqxx::row& row : values.Execute(
                                  transaction,
                                  "SELECT number, digest, seal FROM segment WHERE route = ? AND "
                                  "teaching = ? ORDER BY number")) {
                           const SegmentIndex index(row[0].as<std::uint32_t>());
                           if (const auto digest = ReadSegmentDigest(row, key, index)) {
                             held.push_back({index, *digest});
                           }
                         }
                         return held;
                       });
}

Result<std::vector<HeldTeaching>> PostgresRouteStore::ListHeld(const RouteKey& after,
                                                               std::size_t most) {
  return session_->Run(
      Kind::kRead, "listing the teachings of which it has segments",
      [&](Transaction& transaction) -> Result<std::vector<HeldTeaching>> {
        PostgresValues values;
        values.Add(after);
        values.Add(static_cast<std::int64_t>(most));
        std::vector<HeldTeaching> held;
        for (const pqxx::row& row : values.Execute(transaction, kListHeld)) {
          held.push_back({ReadKey(row), row[2].as<std::uint64_t>(), row[3].as<bool>()});
        }
        return held;
      });
}

Result<std::optional<route::Bytes>> PostgresRouteStore::FindContent(const route::Digest& digest) {
  return session_->Run(Kind::kRead, "looking up a segment's bytes",
                       [&](Transaction& transaction) -> Result<std::optional<route::Bytes>> {
                         PostgresValues values;
                         values.Add(digest);
                         const pqxx::result rows = values.Execute(
                             transaction, "SELECT bytes FROM content WHERE digest = ?");
                         if (rows.empty()) return std::nullopt;
                         route::Bytes bytes = ReadBytes(rows[0][0]);
                         if (route::Sha256(bytes) != digest) return std::nullopt;
                         return bytes;
                       });
}

Result<std::vector<SegmentIndex>> PostgresRouteStore::SelectIndices(const RouteKey& key,
                                                                    bool unreceipted) {
  return session_->Run(
      Kind::kRead, "listing the segments of " + Describe(key),
      [&](Transaction& transaction) -> Result<std::vector<SegmentIndex>> {
        PostgresValues values;
        values.Add(key);
        std::vector<SegmentIndex> indices;
        for (const pqxx::row& row : values.Execute(
                 transaction,
                 fmt::format(
                     "SELECT number FROM segment WHERE route = $1 AND teaching = $2 {} ORDER BY "
                     "number",
                     unreceipted ? "AND number NOT IN (SELECT number FROM receipt WHERE route = $1 "
                                   "AND teaching = $2)"
                                 : ""))) {
          indices.emplace_back(row[0].as<std::uint32_t>());
        }
        return indices;
      });
}

Result<std::vector<SegmentIndex>> PostgresRouteStore::HeldSegments(const RouteKey& key) {
  return SelectIndices(key, false);
}

Result<std::vector<SegmentIndex>> PostgresRouteStore::UnreceiptedSegments(const RouteKey& key) {
  return SelectIndices(key, true);
}

Result<void> PostgresRouteStore::MarkReceipted(const RouteKey& key,
                                               std::span<const SegmentIndex> indices) {
  if (indices.empty()) return {};
  return session_->Run(Kind::kWrite, "noting receipts of " + Describe(key),
                       [&](Transaction& transaction) -> Result<void> {
                         ForSome(indices, [&](auto begin, auto end) {
                           PostgresValues values;
                           for (auto index = begin; index != end; ++index) {
                             values.Add(key);
                             values.Add(std::int64_t{index->value()});
                           }
                           (void)values.Execute(
                               transaction,
                               "INSERT INTO receipt SELECT route, teaching, number FROM segment "
                               "WHERE (route, teaching, number) IN (" +
                                   values.Rows(3) + ") ON CONFLICT DO NOTHING");
                         });
                         return {};
                       });
}

}  // namespace trailcast::store
