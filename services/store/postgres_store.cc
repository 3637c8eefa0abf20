// PostgresRouteStore's segments; its routes are in postgres_routes.cc.
#include "services/store/postgres_store.h"

#include <algorithm>

#include "services/route/digest.h"
#include "services/store/postgres_rows.h"
#include "services/store/row_values.h"
#include "services/store/verify.h"

namespace trailcast::store {
namespace {

using route::RouteKey;
using route::SegmentPiece;

// Rows that one statement takes: PostgreSQL numbers parameters with 16 bits.
constexpr std::size_t kRowsAtOnce = 500;

// Sorted, as two processes that lock the same rows must do so in the same order.
using Pieces = std::map<std::pair<RouteKey, SegmentIndex>, const SegmentPiece*>;

void InsertContents(pqxx::transaction_base& transaction, const Pieces& pieces) {
  std::map<route::Digest, const SegmentPiece*> contents;
  for (const auto& [where, piece] : pieces) contents.emplace(piece->digest, piece);
  PostgresValues values;
  for (const auto& [digest, piece] : contents) {
    values.Add(digest);
    values.AddBytes(piece->bytes.data(), piece->bytes.size());
  }
  // One held already is written again only where it is damaged.
  (void)values.Execute(transaction,
                       "INSERT INTO content (digest, bytes) VALUES " + values.Rows(2) +
                           " ON CONFLICT (digest) DO UPDATE SET bytes = excluded.bytes "
                           "WHERE content.bytes <> excluded.bytes");
}

void InsertSegments(pqxx::transaction_base& transaction, const Pieces& pieces) {
  PostgresValues values;
  for (const auto& [where, piece] : pieces) values.AddSegment(*piece);
  (void)values.Execute(transaction,
                       "INSERT INTO segment (route, revision, number, digest, seal) VALUES " +
                           values.Rows(5) +
                           " ON CONFLICT (route, revision, number) DO UPDATE "
                           "SET digest = excluded.digest, seal = excluded.seal");
}

}  // namespace

void PostgresRouteStore::Lock(Transaction& transaction, const Keys& keys) {
  PostgresValues values;
  for (const RouteKey& key : keys) values.Add(key);
  const std::string rows = values.Rows(2);
  (void)values.Execute(transaction, "INSERT INTO revision (route, revision) VALUES " + rows +
                                        " ON CONFLICT DO NOTHING");
  (void)values.Execute(transaction, "SELECT FROM revision WHERE (route, revision) IN (" + rows +
                                        ") ORDER BY route, revision FOR UPDATE");
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
  Digests held;
  for (; !pieces.empty(); pieces = pieces.subspan(std::min(kRowsAtOnce, pieces.size()))) {
    const auto some = pieces.first(std::min(kRowsAtOnce, pieces.size()));
    FindHeld(transaction, some, held);
    Pieces lacking;
    for (const SegmentPiece& piece : some) {
      const auto [at, is_new] = held.try_emplace({piece.key, piece.index}, piece.digest);
      if (is_new) lacking.emplace(at->first, &piece);
      if (at->second != piece.digest) return Conflict(piece, at->second);
    }
    if (lacking.empty()) continue;
    InsertContents(transaction, lacking);
    InsertSegments(transaction, lacking);
  }
  return {};
}

Result<void> PostgresRouteStore::RefuseBuried(Transaction& transaction, const Keys& keys) const {
  PostgresValues values;
  for (const RouteKey& key : keys) values.Add(key);
  const pqxx::result buried = values.Execute(
      transaction, "SELECT route, revision FROM tombstone WHERE (route, revision) IN (" +
                       values.Rows(2) + ") LIMIT 1");
  if (buried.empty()) return {};
  return Fail(ErrorCode::kConflict, "route store {}: {} was deleted and takes no segments",
              session_->name(), Describe(ReadKey(buried[0])));
}

void PostgresRouteStore::FindHeld(Transaction& transaction, std::span<const SegmentPiece> pieces,
                                  Digests& held) {
  PostgresValues values;
  for (const SegmentPiece& piece : pieces) {
    values.Add(piece.key);
    values.Add(std::int64_t{piece.index.value()});
  }
  const pqxx::result rows = values.Execute(
      transaction,
      "SELECT route, revision, number, digest, seal, bytes FROM segment LEFT JOIN content USING "
      "(digest) WHERE (route, revision, number) IN (" +
          values.Rows(3) + ")");
  for (const pqxx::row& row : rows) {
    const RouteKey key = ReadKey(row);
    const SegmentIndex index(row[2].as<std::uint32_t>());
    if (const auto whole = ReadSegmentRow(row, key, index)) {
      held.try_emplace({key, index}, whole->digest);
    }
  }
}

Result<void> PostgresRouteStore::Conflict(const SegmentPiece& piece,
                                          const route::Digest& held) const {
  return Fail(ErrorCode::kConflict,
              "route store {}: {} is held with other bytes (digest {:.12}.., given {:.12}..); "
              "two scouts may be teaching under one route id",
              session_->name(), Describe(piece.key, piece.index), route::ToHex(held),
              route::ToHex(piece.digest));
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
            "route = ? AND revision = ? AND number = ?");
        if (rows.empty()) {
          return Fail(ErrorCode::kNotFound, "route store {} has no {}", session_->name(), which);
        }
        Result<SegmentPiece> piece = ReadSegmentRow(rows[0], key, index);
        if (!piece) return Wrap(piece.error(), "route store " + session_->name());
        return piece;
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
                     "SELECT number FROM segment WHERE route = ? AND revision = ? {} ORDER BY "
                     "number",
                     unreceipted ? "AND NOT receipted" : ""))) {
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
  return session_->Run(
      Kind::kWrite, "noting receipts of " + Describe(key),
      [&](Transaction& transaction) -> Result<void> {
        for (auto left = indices; !left.empty();
             left = left.subspan(std::min(kRowsAtOnce, left.size()))) {
          PostgresValues values;
          for (const SegmentIndex index : left.first(std::min(kRowsAtOnce, left.size()))) {
            values.Add(key);
            values.Add(std::int64_t{index.value()});
          }
          (void)values.Execute(transaction,
                               "UPDATE segment SET receipted = true WHERE NOT receipted AND "
                               "(route, revision, number) IN (" +
                                   values.Rows(3) + ")");
        }
        return {};
      });
}

Result<std::vector<std::string>> PostgresRouteStore::Verify() {
  const auto keys = session_->Run(
      Kind::kRead, "listing what it holds",
      [](Transaction& transaction) -> Result<std::vector<RouteKey>> {
        std::vector<RouteKey> listed;
        for (const pqxx::row& row : transaction.exec(
                 "SELECT route, revision FROM route UNION SELECT route, revision FROM tombstone "
                 "UNION SELECT route, revision FROM segment ORDER BY 1, 2")) {
          listed.push_back(ReadKey(row));
        }
        return listed;
      });
  if (!keys) return tl::unexpected(keys.error());
  std::vector<std::string> damage;
  for (const RouteKey& key : *keys) {
    const Result<void> verified = VerifyRevision(*this, session_->name(), key, damage);
    if (verified) continue;
    if (verified.error().code != ErrorCode::kCorrupt) return tl::unexpected(verified.error());
    damage.push_back(verified.error().message);
  }
  return damage;
}

Result<std::unique_ptr<RouteStore>> OpenPostgresStore(const std::string& url,
                                                      const PostgresOptions& options) {
  auto session =
      PostgresSession::Open(url, options.read_only ? PostgresSession::Access::kReadOnly
                                                   : PostgresSession::Access::kReadWrite);
  if (!session) return tl::unexpected(session.error());
  return std::make_unique<PostgresRouteStore>(std::move(*session));
}

}  // namespace trailcast::store
