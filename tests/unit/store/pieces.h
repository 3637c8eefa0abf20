#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "services/route/digest.h"
#include "services/route/route.h"

namespace trailcast::store {

inline const route::RouteKey kYard{RouteId("0123456789abcdef0123456789abcdef"), TeachingId(1)};

// Returns a piece as large as a segment of some fifty features. `salt` makes other bytes for the
// same index.
[[nodiscard]] inline route::SegmentPiece Piece(std::uint32_t index, std::uint32_t salt = 0,
                                               std::size_t size = 5000) {
  route::SegmentPiece piece{kYard, SegmentIndex(index), {}, route::Bytes(size)};
  std::uint32_t state = index * 7919U + salt + 1U;
  for (std::uint8_t& byte : piece.bytes) {
    state = state * 1664525U + 1013904223U;
    byte = static_cast<std::uint8_t>(state >> 24U);
  }
  piece.digest = route::Sha256(piece.bytes);
  return piece;
}

[[nodiscard]] inline std::vector<route::SegmentPiece> Pieces(
    std::initializer_list<std::uint32_t> indices) {
  std::vector<route::SegmentPiece> pieces;
  for (const std::uint32_t index : indices) pieces.push_back(Piece(index));
  return pieces;
}

[[nodiscard]] inline std::vector<SegmentIndex> Indices(
    std::initializer_list<std::uint32_t> values) {
  std::vector<SegmentIndex> indices;
  for (const std::uint32_t value : values) indices.emplace_back(value);
  return indices;
}

[[nodiscard]] inline route::RouteInfo Info(std::uint32_t segments, route::RouteState state) {
  route::RouteInfo info;
  info.key = kYard;
  info.name = "yard";
  info.scout = AgentId("scout-1");
  info.camera = "webcam 320x240";
  info.image_width_px = 320;
  info.image_height_px = 240;
  info.taught_unix_ms = 1'700'000'000'000;
  info.state = state;
  info.segment_count = segments;
  info.length_m = 2.5 * segments;
  info.bytes = 5000ULL * segments;
  std::vector<route::Digest> digests;
  for (std::uint32_t i = 0; i < segments; ++i) digests.push_back(Piece(i).digest);
  info.manifest_digest = route::ManifestDigest(digests);
  return info;
}

[[nodiscard]] inline route::RouteInfo Teaching(std::uint32_t segments) {
  return Info(segments, route::RouteState::kTeaching);
}
[[nodiscard]] inline route::RouteInfo Complete(std::uint32_t segments) {
  return Info(segments, route::RouteState::kComplete);
}

}  // namespace trailcast::store
