#include "services/store/src/rows.h"

#include <algorithm>

#include "services/route/digest.h"
#include "services/route/info_codec.h"

namespace trailcast::store {
namespace {

// Returns a digest, or kCorrupt if the column has something else.
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

SqlValue ValueOf(const SQLite::Column& column) {
  if (column.isInteger()) return std::int64_t{column.getInt64()};
  if (column.isFloat()) return column.getDouble();
  if (column.isNull()) return {};
  return column.getString();
}

}  // namespace

int BindValues(SQLite::Statement& statement, const std::vector<SqlValue>& values, int first) {
  for (const SqlValue& value : values) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      statement.bind(first, *text);
    } else if (const auto* number = std::get_if<std::int64_t>(&value)) {
      statement.bind(first, *number);
    } else if (const auto* real = std::get_if<double>(&value)) {
      statement.bind(first, *real);
    } else {
      statement.bind(first);
    }
    ++first;
  }
  return first;
}

void BindBytes(SQLite::Statement& statement, int parameter, const route::Bytes& bytes) {
  statement.bind(parameter, bytes.data(), static_cast<int>(bytes.size()));
}

void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest) {
  statement.bind(parameter, digest.data(), static_cast<int>(digest.size()));
}

void BindKey(SQLite::Statement& statement, const route::RouteKey& key) {
  statement.bind(1, key.route.value());
  statement.bind(2, static_cast<std::int64_t>(key.teaching.value()));
}

TeachingId TeachingOf(const SQLite::Column& column) {
  return TeachingId(static_cast<std::uint64_t>(column.getInt64()));
}

route::Bytes ReadBytes(const SQLite::Column& column) {
  const auto* bytes = static_cast<const std::uint8_t*>(column.getBlob());
  return bytes == nullptr ? route::Bytes() : route::Bytes(bytes, bytes + column.getBytes());
}

void BindRoute(SQLite::Statement& statement, const route::RouteInfo& info) {
  const route::Bytes bytes = route::EncodeInfo(info);
  const int after = BindValues(statement, FoundBy(info));
  BindBytes(statement, after, bytes);
  BindDigest(statement, after + 1, route::Sha256(bytes));
}

Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement) {
  auto info = OpenInfo(
      ReadBytes(statement.getColumn(kFoundByCount)),
      ReadBytes(statement.getColumn(kFoundByCount + 1)),
      [&](int i, const SqlValue& value) { return ValueOf(statement.getColumn(i)) == value; });
  if (info) return info;
  return DamagedRoute(
      {RouteId(statement.getColumn(0).getString()), TeachingOf(statement.getColumn(1))},
      statement.getColumn(3).getString());
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
