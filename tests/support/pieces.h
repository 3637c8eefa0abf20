#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "services/exchange/integrity.h"
#include "services/exchange/messages.h"
#include "services/route/digest.h"
#include "services/route/route.h"

namespace trailcast::test {

// These are routes of made-up bytes, for tests of what carries them. The digests are no SHA-256,
// but differ when a byte does.
[[nodiscard]] inline route::Digest ToyDigest(std::span<const std::uint8_t> bytes) {
  route::Digest digest{};
  std::uint64_t hash = 14695981039346656037ULL;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    digest[i] = static_cast<std::uint8_t>(hash >> (8U * (i % 8U)));
  }
  digest[31] = 1;  // never all zero
  return digest;
}

[[nodiscard]] inline route::Digest ToyManifest(std::span<const route::Digest> digests) {
  route::Bytes bytes;
  for (const route::Digest& digest : digests) {
    bytes.insert(bytes.end(), digest.begin(), digest.end());
  }
  return ToyDigest(bytes);
}

[[nodiscard]] inline exchange::Integrity ToyIntegrity() {
  const auto check = [](const route::SegmentPiece& piece) -> Result<void> {
    if (ToyDigest(piece.bytes) == piece.digest) return {};
    return Fail(ErrorCode::kCorrupt, "segment {} fails its digest", piece.index.value());
  };
  return {.check_piece = check, .manifest = ToyManifest};
}

[[nodiscard]] inline route::RouteKey KeyNumber(unsigned number, std::uint64_t teaching = 1) {
  return {RouteId(fmt::format("{:032x}", number)), TeachingId(teaching)};
}

[[nodiscard]] inline route::SegmentPiece PieceOf(const route::RouteKey& key, std::uint32_t index,
                                                 std::size_t size = 100, std::uint8_t salt = 0) {
  route::SegmentPiece piece{.key = key, .index = SegmentIndex(index), .digest = {}, .bytes = {}};
  for (std::size_t i = 0; i < size; ++i) {
    piece.bytes.push_back(
        static_cast<std::uint8_t>(std::size_t{index} * 31U + i * 7U + i / 251U + salt));
  }
  piece.digest = ToyDigest(piece.bytes);
  return piece;
}

[[nodiscard]] inline std::vector<route::SegmentPiece> PiecesOf(const route::RouteKey& key,
                                                               std::uint32_t count,
                                                               std::size_t size = 100) {
  std::vector<route::SegmentPiece> pieces;
  for (std::uint32_t i = 0; i < count; ++i) pieces.push_back(PieceOf(key, i, size));
  return pieces;
}

// Returns what a scout announces of these pieces, which are segments 0, 1, 2, ... The revision has
// the number of its teaching.
[[nodiscard]] inline route::RouteInfo InfoOf(const route::RouteKey& key,
                                             std::span<const route::SegmentPiece> pieces,
                                             route::RouteState state) {
  route::RouteInfo info{
      .key = key,
      .name = "corridor",
      .revision = RevisionNumber(static_cast<std::uint32_t>(key.teaching.value())),
      .scout = AgentId("scout-1"),
      .camera = "webcam 320x240",
      .image_width_px = 320,
      .image_height_px = 240,
      .taught_unix_ms = 1'700'000'000'000,
      .state = state,
      .segment_count = static_cast<std::uint32_t>(pieces.size()),
      .length_m = 2.0 * static_cast<double>(pieces.size()),
      .bytes = 0,
      .manifest_digest = {}};
  std::vector<route::Digest> digests;
  for (const route::SegmentPiece& piece : pieces) {
    info.bytes += piece.bytes.size();
    digests.push_back(piece.digest);
  }
  info.manifest_digest = ToyManifest(digests);
  return info;
}

// Returns the acknowledgement of a server that has the first `prefix` of these pieces, and those
// `beyond`.
[[nodiscard]] inline exchange::Receipt ReceiptFor(
    const AgentId& server, const route::RouteKey& key, std::span<const route::SegmentPiece> pieces,
    std::uint32_t prefix, const std::vector<SegmentIndex>& beyond = {},
    route::RouteState state = route::RouteState::kTeaching) {
  exchange::Receipt receipt{.server = server, .key = key, .durable_prefix = prefix};
  for (std::uint32_t i = 0; i < prefix; ++i) {
    receipt.prefix_digest = route::ChainDigest(receipt.prefix_digest, pieces[i].digest);
  }
  for (const SegmentIndex index : beyond) {
    const bool is_there = index.value() < pieces.size();
    receipt.durable_beyond.push_back(
        {index, is_there ? pieces[index.value()].digest : ToyDigest({})});
  }
  receipt.durable_state = state;
  return receipt;
}

[[nodiscard]] inline std::vector<SegmentIndex> Indices(std::uint32_t first, std::uint32_t end) {
  std::vector<SegmentIndex> indices;
  for (std::uint32_t i = first; i < end; ++i) indices.emplace_back(i);
  return indices;
}

// Returns the messages of one kind, in order.
template <typename Kind>
[[nodiscard]] std::vector<Kind> Only(const std::vector<exchange::Message>& messages) {
  std::vector<Kind> kept;
  for (const exchange::Message& message : messages) {
    if (const auto* value = std::get_if<Kind>(&message)) kept.push_back(*value);
  }
  return kept;
}

// Returns the pieces of all batches, in order.
[[nodiscard]] inline std::vector<route::SegmentPiece> PiecesIn(
    const std::vector<exchange::Message>& messages) {
  std::vector<route::SegmentPiece> pieces;
  for (const auto& batch : Only<exchange::SegmentBatch>(messages)) {
    pieces.insert(pieces.end(), batch.pieces.begin(), batch.pieces.end());
  }
  return pieces;
}

}  // namespace trailcast::test
