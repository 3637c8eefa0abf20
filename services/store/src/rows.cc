#include "services/store/src/rows.h"

#include <algorithm>

#include "services/route/digest.h"

namespace trailcast::store {
namespace {

std::optional<route::Place> ReadPlace(const SQLite::Statement& statement, int first) {
  if (statement.getColumn(first).isNull()) return std::nullopt;
  return route::Place{static_cast<route::Place::Frame>(statement.getColumn(first).getInt()),
                      statement.getColumn(first + 1).getDouble(),
                      statement.getColumn(first + 2).getDouble()};
}

// A digest, or kCorrupt when the column holds something else.
Result<route::Digest> ReadDigest(const SQLite::Column& column) {
  route::Digest digest{};
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  if (bytes == nullptr || column.getBytes() != static_cast<int>(digest.size())) {
    return Fail(ErrorCode::kCorrupt, "a digest has {} bytes, expected {}", column.getBytes(),
                digest.size());
  }
  std::copy_n(bytes, digest.size(), digest.begin());
  return digest;
}

// None if the column is NULL.
route::Bytes ReadBytes(const SQLite::Column& column) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return bytes == nullptr ? route::Bytes() : route::Bytes(bytes, bytes + column.getBytes());
}

// The row, if it fits the seal that it has.
Result<route::RouteInfo> ReadSealed(const SQLite::Statement& statement,
                                    route::Digest (*seal_of)(const route::RouteInfo&)) {
  route::RouteInfo info;
  info.key.route = RouteId(statement.getColumn(0).getString());
  info.key.teaching = TeachingOf(statement.getColumn(1));
  info.name = statement.getColumn(2).getString();
  info.scout = AgentId(statement.getColumn(3).getString());
  info.camera = statement.getColumn(4).getString();
  info.image_width_px = statement.getColumn(5).getInt();
  info.image_height_px = statement.getColumn(6).getInt();
  info.taught_unix_ms = statement.getColumn(7).getInt64();
  info.state = statement.getColumn(8).getInt() == 0 ? route::RouteState::kTeaching
                                                    : route::RouteState::kComplete;
  info.segment_count = statement.getColumn(9).getUInt();
  info.length_m = statement.getColumn(10).getDouble();
  info.bytes = static_cast<std::uint64_t>(statement.getColumn(11).getInt64());
  const Result<route::Digest> manifest = ReadDigest(statement.getColumn(12));
  const Result<route::Digest> seal = ReadDigest(statement.getColumn(13));
  info.tags = SplitTags(statement.getColumn(14).getString());
  info.place = ReadPlace(statement, 15);
  info.description = statement.getColumn(18).getString();
  info.standing = static_cast<route::Standing>(statement.getColumn(19).getInt());
  info.edition = statement.getColumn(20).getUInt();
  info.revision = RevisionNumber(statement.getColumn(21).getUInt());
  info.cut_off = statement.getColumn(22).getInt() != 0;
  if (manifest) info.manifest_digest = *manifest;
  if (!manifest || !seal || *seal != seal_of(info)) {
    return DamagedRoute(info);
  }
  return info;
}

}  // namespace

TeachingId TeachingOf(const SQLite::Column& column) {
  return TeachingId(static_cast<std::uint64_t>(column.getInt64()));
}

void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest) {
  statement.bind(parameter, digest.data(), static_cast<int>(digest.size()));
}

void BindKey(SQLite::Statement& statement, const route::RouteKey& key) {
  statement.bind(1, key.route.value());
  statement.bind(2, static_cast<std::int64_t>(key.teaching.value()));
}

void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info) {
  BindKey(statement, info.key);
  statement.bind(3, info.name);
  statement.bind(4, info.scout.value());
  statement.bind(5, info.camera);
  statement.bind(6, info.image_width_px);
  statement.bind(7, info.image_height_px);
  statement.bind(8, info.taught_unix_ms);
  statement.bind(9, static_cast<int>(info.state));
  statement.bind(10, info.segment_count);
  statement.bind(11, info.length_m);
  statement.bind(12, static_cast<std::int64_t>(info.bytes));
  BindDigest(statement, 13, info.manifest_digest);
  BindDigest(statement, 14, Seal(info));
  statement.bind(15, JoinTags(info.tags));
  statement.bind(19, info.description);
  statement.bind(20, static_cast<int>(info.standing));
  statement.bind(21, info.edition);
  statement.bind(22, info.revision.value());
  statement.bind(23, info.cut_off ? 1 : 0);
  if (!info.place) return;  // NULLs
  statement.bind(16, static_cast<int>(info.place->frame));
  statement.bind(17, info.place->x);
  statement.bind(18, info.place->y);
}

Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement) {
  return ReadSealed(statement, &Seal);
}

Result<route::RouteInfo> ReadRouteOf4(const SQLite::Statement& statement) {
  return ReadSealed(statement, &SealBefore5);
}

void BindSegment(SQLite::Statement& statement, const route::SegmentPiece& piece) {
  BindKey(statement, piece.key);
  statement.bind(3, piece.index.value());
  BindDigest(statement, 4, piece.digest);
  BindDigest(statement, 5, Seal(piece));
  if (piece.bytes.empty()) return;  // NULL
  statement.bindNoCopy(6, piece.bytes.data(), static_cast<int>(piece.bytes.size()));
}

Result<route::SegmentPiece> ReadSegmentRow(const SQLite::Statement& statement,
                                           const route::RouteKey& key, SegmentIndex index) {
  const Result<route::Digest> digest = ReadDigest(statement.getColumn(0));
  if (!digest) return Wrap(digest.error(), Describe(key, index));
  const Result<route::Digest> seal = ReadDigest(statement.getColumn(1));
  if (!seal) return Wrap(seal.error(), Describe(key, index));
  route::SegmentPiece piece{key, index, *digest, ReadBytes(statement.getColumn(2))};
  if (*seal != Seal(piece)) {
    return DamagedSegment(key, index);
  }
  return piece;
}

}  // namespace trailcast::store
