#pragma once

#include <memory>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

[[nodiscard]] Digest Sha256(std::span<const std::uint8_t> bytes);

// This computes the same for bytes that come piece by piece.
class Sha256Stream {
 public:
  Sha256Stream();
  ~Sha256Stream();
  Sha256Stream(Sha256Stream&&) noexcept;
  Sha256Stream& operator=(Sha256Stream&&) noexcept;

  void Add(std::span<const std::uint8_t> bytes);
  // Returns the digest of all that was added. Nothing may be added afterwards.
  [[nodiscard]] Digest Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the RouteInfo::manifest_digest of segments with these digests, in order.
[[nodiscard]] Digest ManifestDigest(std::span<const Digest> digests);
// Returns the digest of a route's first segments from `before`, the one without the last of them,
// and `next`, that segment's digest: SHA-256 of both. The one before the first segment is zero. Two
// routes have the same one if these segments are the same.
[[nodiscard]] Digest ChainDigest(const Digest& before, const Digest& next);

// Encodes and hashes a segment. A scout stores and publishes the result.
[[nodiscard]] SegmentPiece MakePiece(const RouteKey& key, const Segment& segment);
// Fails with kCorrupt, which names route and segment, if the bytes are not those that were hashed.
[[nodiscard]] Result<void> CheckDigest(const SegmentPiece& piece);
// Checks the digest, decodes, and fails with kCorrupt, too, if the decoded index is not the
// piece's.
[[nodiscard]] Result<Segment> Open(const SegmentPiece& piece);

}  // namespace trailcast::route
