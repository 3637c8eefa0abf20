#include "services/store/rows.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>

#include "services/route/codec.h"
#include "services/route/digest.h"

namespace trailcast::store {
namespace {

constexpr std::size_t kMaxCameraBytes = 128;
constexpr int kMaxImagePx = 65536;

route::Digest Sha256(const std::string& text) {
  return route::Sha256({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

// Seals are digests of a row's other columns as text: SQLite does not notice a changed byte, and a
// damaged index can lead to the wrong row. Part of the store's format.
// Without tags and place it is that of version 1, with the labels as taught that of version 2.
route::Digest Seal(const route::RouteInfo& info) {
  std::string text = fmt::format(
      "{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{:a}\n{}\n{}\n", info.key.route.value(),
      info.key.revision.value(), info.name, info.scout.value(), info.camera, info.image_width_px,
      info.image_height_px, info.taught_unix_ms, static_cast<int>(info.state), info.segment_count,
      info.length_m, info.bytes, route::ToHex(info.manifest_digest));
  for (const std::string& tag : info.tags) text += fmt::format("tag {}\n", tag);
  if (info.place) {
    text += fmt::format("place {} {:a} {:a}\n", static_cast<int>(info.place->frame), info.place->x,
                        info.place->y);
  }
  return Sha256(text);
}

route::Digest Seal(const route::SegmentPiece& piece) {
  return Sha256(fmt::format("{}\n{}\n{}\n{}\n", piece.key.route.value(), piece.key.revision.value(),
                            piece.index.value(), route::ToHex(piece.digest)));
}

tl::unexpected<Error> Refuse(const route::RouteInfo& info, std::string_view field,
                             const std::string& expected) {
  return Fail(ErrorCode::kInvalidArgument, "{} cannot be stored: its {} {}", Describe(info.key),
              field, expected);
}

// As text they are one column; route_tag, by which routes are found, is made from it.
std::string JoinTags(const std::vector<std::string>& tags) {
  return fmt::format("{}", fmt::join(tags, " "));
}

std::vector<std::string> SplitTags(const std::string& joined) {
  std::vector<std::string> tags;
  std::istringstream words(joined);
  for (std::string tag; words >> tag;) tags.push_back(tag);
  return tags;
}

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

}  // namespace

std::string Describe(const route::RouteKey& key) {
  return fmt::format("route {} revision {}", key.route.value(), key.revision.value());
}

std::string Describe(const route::RouteKey& key, SegmentIndex index) {
  return fmt::format("segment {} of {}", index.value(), Describe(key));
}

Result<void> CheckRoute(const route::RouteInfo& info) {
  const std::string name_rule = "must be 1 to 64 of [A-Za-z0-9_.-]";
  if (!IsValidName(info.key.route.value())) return Refuse(info, "id", name_rule);
  if (!IsValidName(info.name)) return Refuse(info, "name", name_rule);
  if (!IsValidName(info.scout.value())) return Refuse(info, "scout", name_rule);
  if (info.camera.size() > kMaxCameraBytes) {
    return Refuse(info, "camera", fmt::format("must have at most {} bytes", kMaxCameraBytes));
  }
  const auto [smallest, largest] = std::minmax(info.image_width_px, info.image_height_px);
  if (smallest < 0 || largest > kMaxImagePx) {
    return Refuse(info, "image size", fmt::format("must lie in 0..{}", kMaxImagePx));
  }
  if (!std::isfinite(info.length_m)) return Refuse(info, "length", "must be finite");
  if (info.bytes > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    return Refuse(info, "number of bytes", "must be below 2^63");
  }
  if (info.tags.size() > route::kMaxTags ||
      !std::all_of(info.tags.begin(), info.tags.end(), &IsValidName) ||
      std::adjacent_find(info.tags.begin(), info.tags.end(), std::greater_equal<>()) !=
          info.tags.end()) {
    return Refuse(info, "tags",
                  fmt::format("must be at most {} names of [A-Za-z0-9_.-], sorted, none twice",
                              route::kMaxTags));
  }
  if (info.place && (!std::isfinite(info.place->x) || !std::isfinite(info.place->y))) {
    return Refuse(info, "place", "must be finite");
  }
  if (info.description.size() > route::kMaxDescriptionBytes) {
    return Refuse(info, "description",
                  fmt::format("must have at most {} bytes", route::kMaxDescriptionBytes));
  }
  if (info.standing > route::Standing::kDeleted) {
    return Refuse(info, "standing", "must be staged, active, retired or deleted");
  }
  if (info.state != route::RouteState::kTeaching && info.state != route::RouteState::kComplete) {
    return Refuse(info, "state", "must be teaching or complete");
  }
  return {};
}

void BindDigest(SQLite::Statement& statement, int parameter, const route::Digest& digest) {
  statement.bind(parameter, digest.data(), static_cast<int>(digest.size()));
}

void BindKey(SQLite::Statement& statement, const route::RouteKey& key) {
  statement.bind(1, key.route.value());
  statement.bind(2, key.revision.value());
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
  if (!info.place) return;  // NULLs
  statement.bind(16, static_cast<int>(info.place->frame));
  statement.bind(17, info.place->x);
  statement.bind(18, info.place->y);
}

Result<route::RouteInfo> ReadRoute(const SQLite::Statement& statement) {
  route::RouteInfo info;
  info.key.route = RouteId(statement.getColumn(0).getString());
  info.key.revision = RevisionNumber(statement.getColumn(1).getUInt());
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
  if (manifest) info.manifest_digest = *manifest;
  if (!manifest || !seal || *seal != Seal(info)) {
    return Fail(ErrorCode::kCorrupt,
                "what is known of {} (named '{}') is damaged; it mends when a holder announces it",
                Describe(info.key), info.name);
  }
  return info;
}

Result<void> CheckSegment(const route::SegmentPiece& piece) {
  if (!IsValidName(piece.key.route.value())) {
    return Fail(ErrorCode::kInvalidArgument,
                "a segment cannot be stored: its route's id must be 1 to 64 of [A-Za-z0-9_.-]");
  }
  if (piece.bytes.empty() || piece.bytes.size() > route::kMaxSegmentBytes) {
    return Fail(ErrorCode::kCorrupt, "{} has {} bytes, expected 1 to {}",
                Describe(piece.key, piece.index), piece.bytes.size(), route::kMaxSegmentBytes);
  }
  return route::CheckDigest(piece);
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
    return Fail(ErrorCode::kCorrupt,
                "{}: its row is damaged; it mends when the segment is stored again",
                Describe(key, index));
  }
  return piece;
}

}  // namespace trailcast::store
