#pragma once

#include <memory>
#include <span>
#include <string>

#include "services/base/result.h"
#include "services/route/route.h"

namespace trailcast::route {

[[nodiscard]] Digest Sha256(std::span<const std::uint8_t> bytes);

// The same of bytes that come piece by piece.
class Sha256Stream {
 public:
  Sha256Stream();
  ~Sha256Stream();
  Sha256Stream(Sha256Stream&&) noexcept;
  Sha256Stream& operator=(Sha256Stream&&) noexcept;

  void Add(std::span<const std::uint8_t> bytes);
  // Of all that was added. Nothing may be added afterwards.
  [[nodiscard]] Digest Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// RouteInfo::manifest_digest of segments with these digests, in order.
[[nodiscard]] Digest ManifestDigest(std::span<const Digest> digests);
// Of a route's first segments, one by one: zero before the first, then SHA-256 of what it was
// before the segment and of the segment's digest. Two routes' are the same if these segments are.
[[nodiscard]] Digest ChainDigest(const Digest& before, const Digest& next);
// Lower-case hexadecimal.
[[nodiscard]] std::string ToHex(const Digest& digest);

// Encodes and hashes: what a scout stores and publishes.
[[nodiscard]] SegmentPiece MakePiece(const RouteKey& key, const Segment& segment);
// kCorrupt, naming route and segment, if the bytes are not those that were hashed.
[[nodiscard]] Result<void> CheckDigest(const SegmentPiece& piece);
// CheckDigest, then Decode, then the decoded index must be the piece's.
[[nodiscard]] Result<Segment> Open(const SegmentPiece& piece);

}  // namespace trailcast::route
