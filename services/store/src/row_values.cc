#include "services/store/src/row_values.h"

#include <algorithm>
#include <array>

#include "services/base/hex.h"
#include "services/route/bounds.h"
#include "services/route/digest.h"
#include "services/route/info_codec.h"

namespace trailcast::store {

std::string Marks(int count) {
  std::string marks = "?";
  for (int i = 1; i < count; ++i) marks += ",?";
  return marks;
}

std::vector<SqlValue> FoundBy(const route::RouteInfo& info) {
  const auto number = [](auto value) { return SqlValue(static_cast<std::int64_t>(value)); };
  std::vector<SqlValue> values{info.key.route.value(),
                               number(info.key.teaching.value()),
                               number(info.revision.value()),
                               info.name,
                               info.scout.value(),
                               info.camera,
                               info.taught_unix_ms,
                               number(info.state),
                               number(info.segment_count),
                               info.length_m,
                               number(info.standing)};
  values.resize(kFoundByCount);
  if (info.place) {
    std::array place{number(info.place->frame), SqlValue(info.place->x), SqlValue(info.place->y)};
    std::move(place.begin(), place.end(), values.end() - place.size());
  }
  return values;
}

Result<route::RouteInfo> OpenInfo(const route::Bytes& bytes, const route::Bytes& seal,
                                  const std::function<bool(int, const SqlValue&)>& is) {
  const route::Digest sealed = route::Sha256(bytes);
  if (!std::equal(seal.begin(), seal.end(), sealed.begin(), sealed.end())) {
    return Fail(ErrorCode::kCorrupt, "the bytes of what is known of a route fail their seal");
  }
  Result<route::RouteInfo> info = route::DecodeInfo(bytes);
  if (!info) return info;
  const std::vector<SqlValue> values = FoundBy(*info);
  for (int column = 0; column < kFoundByCount; ++column) {
    if (!is(column, values[static_cast<std::size_t>(column)])) {
      return Fail(ErrorCode::kCorrupt, "a route would be found by what it is not");
    }
  }
  return info;
}

route::Digest Seal(const route::SegmentPiece& piece) {
  const std::string text =
      fmt::format("{}\n{}\n{}\n{}\n", piece.key.route.value(), piece.key.teaching.value(),
                  piece.index.value(), ToHex(piece.digest));
  return route::Sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

std::string Describe(const route::RouteKey& key, SegmentIndex index) {
  return fmt::format("segment {} of {}", index.value(), Describe(key));
}

tl::unexpected<Error> DamagedRoute(const route::RouteKey& key, const std::string& name) {
  return Fail(ErrorCode::kCorrupt,
              "what is known of {} (named '{}') is damaged; it mends when a holder announces it",
              Describe(key), name);
}

tl::unexpected<Error> DamagedSegment(const route::RouteKey& key, SegmentIndex index) {
  return Fail(ErrorCode::kCorrupt,
              "{}: its row is damaged; it mends when the segment is stored again",
              Describe(key, index));
}

Result<void> CheckRoute(const route::RouteInfo& info) {
  const Result<void> possible = route::CheckInfo(info);
  if (possible) return {};
  return Wrap(possible.error(), fmt::format("{} cannot be stored", Describe(info.key)));
}

Result<void> CheckSegment(const route::SegmentPiece& piece) {
  if (const Result<void> possible = route::CheckKey(piece.key); !possible) {
    return Wrap(possible.error(), "a segment cannot be stored");
  }
  if (piece.bytes.empty() || piece.bytes.size() > route::kMaxSegmentBytes) {
    return Fail(ErrorCode::kCorrupt, "{} has {} bytes, expected 1 to {}",
                Describe(piece.key, piece.index), piece.bytes.size(), route::kMaxSegmentBytes);
  }
  return route::CheckDigest(piece);
}

}  // namespace trailcast::store
